// Rendered frames for a viewer. The preview does not know how they are rendered: only programs link host and nodes.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "host/preview/pictures.h"
#include "node/wire/film_parts.h"

namespace mars::preview {

class SurfaceSource {
 public:
  virtual ~SurfaceSource() = default;

  // From now on renders these frames, in this order, at this size, seen by `camera` or else the film's; what was
  // being rendered is dropped.
  virtual void aim(images::PictureSize extent, const std::optional<wire::Camera>& camera,
                   std::vector<std::uint32_t> frames) = 0;

  // nullptr: not rendered yet. Throws what ended the rendering.
  virtual SharedImage frame(std::uint32_t number) = 0;
  // Waits for it.
  virtual SharedImage wait_for(std::uint32_t number) = 0;
};

}  // namespace mars::preview
