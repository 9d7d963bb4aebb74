// How the files of frames are made: their format, their compression, their names and what shows their light.
#pragma once

#include <compare>

#include "host/images/display_view.h"
#include "host/images/frame_names.h"
#include "host/images/picture_format.h"

namespace mars::images {

struct FrameForm {
  PictureFormat format = PictureFormat::png;
  Compression compression = Compression::zip;
  FrameNames names{};
  ViewName view{};            // by which PNG files show light; empty: by the film's curve
  wire::LayerSet layers = 0;  // of EXR files

  auto operator<=>(const FrameForm&) const = default;
};

}  // namespace mars::images
