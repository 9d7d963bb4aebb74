// What shading takes from a scene's current frame.
#pragma once

#include "node/geometry/scene.h"
#include "node/shading/shading.h"
#include "node/wire/pixel_format.h"

namespace mars::shading {

// All but the triangles, which are not the scene's. Points into the scene, until its frame changes.
Shading shading_of(const geometry::Scene& scene, wire::PixelFormat format = wire::PixelFormat::rgb8);

}  // namespace mars::shading
