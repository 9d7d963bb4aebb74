#include "hal/failure/failure.h"
#include "host/images/jpeg_file.h"

namespace mars::images {

Image decode_jpeg(std::span<const std::byte>, const std::string& name) {
  throw Failure("is JPEG, which this MARS was built without", name,
                "run ./bootstrap, which installs libjpeg-turbo (Debian: libturbojpeg0-dev); or export textures as PNG");
}

}  // namespace mars::images
