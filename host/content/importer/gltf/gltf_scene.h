// What a glTF file has besides meshes and skins: where its nodes are at any time, cameras and lights.
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "host/content/importer/gltf/gltf_animation.h"

namespace mars::importer {

// Looks along its node's -z, y upward in the picture.
struct GltfCamera {
  std::size_t node;
  std::optional<double> yfov;                 // radians, of a perspective camera
  double ymag = 1;                            // of an orthographic one, half of the height that it shows
  std::optional<double> aspect, znear, zfar;  // width by height; none: the file does not say it
};

enum class GltfLightKind { directional, point, spot };

// KHR_lights_punctual: shines along its node's -z.
struct GltfLight {
  std::size_t node;
  GltfLightKind kind;
  glm::dvec3 color{1};                           // amounts of light
  double intensity = 1;                          // lux of directional lights, candela of others
  bool in_the_middle = false;                    // of FBX and COLLADA: what makes a white surface there, instead
  double inner = 0, outer = 0.7853981633974483;  // radians from a spot's axis
};

struct GltfScene {
  GltfNodes nodes;
  GltfAnimations animations;
  std::vector<GltfCamera> cameras;  // in the scene, in the order of their nodes
  std::vector<GltfLight> lights;
  std::size_t unread_lights = 0;  // of a kind that is not known

  // From each node's axes to the file's.
  std::vector<glm::dmat4> matrices_at(double time) const;
};

// Of the animation `animation`, the first where that is "". Refuses what gltf_nodes() and gltf_animations() refuse.
GltfScene read_gltf_scene(const std::filesystem::path& path, const std::string& animation);

}  // namespace mars::importer
