#include "host/images/picture_size.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "hal/failure/failure.h"
#include "host/content/document/text.h"
#include "node/wire/film_parts.h"

namespace mars::images {

PictureSize with_square_pixels(PictureSize size, double pixel_aspect) {
  const long width = std::lround(size.width * pixel_aspect);
  return {static_cast<std::uint32_t>(std::clamp<long>(width, 1, wire::kMaxSide)), size.height};
}

PictureSize read_picture_size(const std::string& text) {
  const std::size_t cross = std::min(text.find('x'), text.size());
  const auto width = document::number_in<std::uint32_t>(std::string_view(text).substr(0, cross));
  const auto height =
      document::number_in<std::uint32_t>(std::string_view(text).substr(std::min(cross + 1, text.size())));
  if (!width || !height) throw Failure("'" + text + "' is not a size", "", "write width and height like 960x540");
  if (std::min(*width, *height) < 1 || std::max(*width, *height) > wire::kMaxSide)
    throw Failure("'" + text + "' is not between 1x1 and " + std::to_string(wire::kMaxSide) + " pixels a side", "", "");
  return {*width, *height};
}

}  // namespace mars::images
