// How the files of frames are made: their format, their compression and their names.
#pragma once

#include <compare>

#include "host/images/frame_names.h"
#include "host/images/picture_format.h"

namespace mars::images {

struct FrameForm {
  PictureFormat format = PictureFormat::png;
  Compression compression = Compression::zip;
  FrameNames names{};
  wire::LayerSet layers = 0;  // of EXR files

  auto operator<=>(const FrameForm&) const = default;
};

}  // namespace mars::images
