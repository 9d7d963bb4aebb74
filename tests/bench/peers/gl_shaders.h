// peer-llvmpipe's shaders. What stays the same for a scene is written into them as numbers. Pictures are drawn upside
// down: OpenGL's first line is the upper one then, and llvmpipe's samples are where ours are.
#pragma once

#include <string>

#include "tests/bench/peers/mesh.h"

namespace mars::bench {

struct Shaders {
  std::string vertex, fragment;
};

// `map`: the numbers of a shadow map (shadow_map.h); empty: no shadows.
Shaders surface_shaders(const MeshHead& head, const std::string& map);

// Of meshes with skins of `bones` bones, without shadows.
Shaders skin_shaders(const MeshHead& head, int bones);

// As surface_shaders(), which also draw into two more colours what shadows of what moves need: what no light makes of a
// pixel and its distance, 0 where there is nothing; and what all light adds.
Shaders kept_surface_shaders(const MeshHead& head, const std::string& map);

// What stands under the map as it is now, from those two colours: `samples` 0 if they are not multisampled.
Shaders shadow_shaders(const MeshHead& head, const std::string& map, int samples);

// Depths as the light sees them.
Shaders map_shaders(const std::string& map);

}  // namespace mars::bench
