#include "host/content/importer/model_size.h"

#include "hal/failure/failure.h"

namespace mars::importer {

double ModelSize::factor(double height_of_file, const std::string& file) const {
  if (!height) return scale;
  if (!(height_of_file > 0))
    throw Failure("is flat: it has no height", file, "leave out --height, or choose what points up with --up");
  return *height / height_of_file;
}

}  // namespace mars::importer
