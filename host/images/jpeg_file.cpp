#include "host/images/jpeg_file.h"

#include <turbojpeg.h>

#include <memory>

#include "hal/failure/failure.h"
#include "node/wire/film_parts.h"

namespace mars::images {

Image decode_jpeg(std::span<const std::byte> bytes, const std::string& name) {
  const std::unique_ptr<void, decltype(&tjDestroy)> decoder(tjInitDecompress(), &tjDestroy);
  check(decoder != nullptr, "libjpeg-turbo starts");
  const auto torn = [&](const std::string& reason) {
    return Failure("not a whole JPEG picture: " + reason, name, "export it again");
  };
  const auto* file = reinterpret_cast<const unsigned char*>(bytes.data());
  int width = 0, height = 0, subsampling = 0, space = 0;
  if (tjDecompressHeader3(decoder.get(), file, bytes.size(), &width, &height, &subsampling, &space) != 0)
    throw torn("it does not begin as one, or is cut short");
  constexpr int kMost = static_cast<int>(wire::kMaxSide);
  if (width < 1 || height < 1 || width > kMost || height > kMost)
    throw torn("it has " + std::to_string(width) + "x" + std::to_string(height) + " pixels");
  Image image{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), {}};
  image.pixels.resize(std::size_t{image.width} * image.height);
  if (tjDecompress2(decoder.get(), file, bytes.size(), reinterpret_cast<unsigned char*>(image.pixels.data()), width, 0,
                    height, TJPF_RGBX, 0) != 0)
    throw torn("its bytes are cut short or damaged");
  return image;
}

}  // namespace mars::images
