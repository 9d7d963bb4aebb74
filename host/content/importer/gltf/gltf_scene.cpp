#include "host/content/importer/gltf/gltf_scene.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "hal/failure/failure.h"
#include "host/content/document/file.h"
#include "host/content/importer/gltf/unpacked_gltf.h"
#include "host/content/modeler/joint.h"

namespace mars::importer {
namespace {

constexpr std::array<std::pair<std::string_view, GltfLightKind>, 3> kLightKinds{
    {{"directional", GltfLightKind::directional}, {"point", GltfLightKind::point}, {"spot", GltfLightKind::spot}}};

std::optional<double> positive(const Tree& tree, const char* key) {
  const Tree& value = at(tree, key);
  return value.is_number() && value.get<double>() > 0 ? std::optional(value.get<double>()) : std::nullopt;
}

double real(const Tree& tree, const char* key, double otherwise) {
  const Tree& value = at(tree, key);
  return value.is_number() ? value.get<double>() : otherwise;
}

// Nodes that are in the file's scene.
std::vector<bool> nodes_in_scene(const Tree& gltf, const std::vector<std::size_t>& parents) {
  std::vector<bool> is_root(parents.size());
  for (const std::size_t root : root_nodes(gltf)) is_root[root] = true;
  std::vector<bool> in(parents.size());
  for (std::size_t node = 0; node < parents.size(); ++node)
    for (std::size_t above = node; above != modeler::kNone && !in[node]; above = parents[above])
      in[node] = is_root[above];
  return in;
}

GltfCamera camera_of(const Tree& camera, std::size_t node) {
  const Tree& perspective = at(camera, "perspective");
  if (!perspective.is_null())
    return {node,
            positive(perspective, "yfov").value_or(0.7),
            1,
            positive(perspective, "aspectRatio"),
            positive(perspective, "znear"),
            positive(perspective, "zfar")};
  const Tree& flat = at(camera, "orthographic");
  GltfCamera read{node, {}, positive(flat, "ymag").value_or(1), {}, positive(flat, "znear"), positive(flat, "zfar")};
  if (const auto xmag = positive(flat, "xmag")) read.aspect = *xmag / read.ymag;
  return read;
}

std::optional<GltfLight> light_of(const Tree& light, std::size_t node) {
  const Tree &type = at(light, "type"), &color = at(light, "color"), &spot = at(light, "spot");
  const auto kind = std::ranges::find(kLightKinds, type.is_string() ? type.get<std::string>() : "",
                                      &std::pair<std::string_view, GltfLightKind>::first);
  if (kind == kLightKinds.end()) return std::nullopt;
  GltfLight read{node, kind->second};
  for (int i = 0; i < 3; ++i)
    if (color.is_array() && color.size() == 3 && color[i].is_number()) read.color[i] = color[i].get<double>();
  read.intensity = real(light, "intensity", read.intensity);
  read.inner = real(spot, "innerConeAngle", read.inner);
  read.outer = real(spot, "outerConeAngle", read.outer);
  return read;
}

}  // namespace

std::vector<glm::dmat4> GltfScene::matrices_at(double time) const {
  return animations.shown ? gltf_matrices(moved(nodes, *animations.shown, time)) : gltf_matrices(nodes);
}

GltfScene read_gltf_scene(const std::filesystem::path& path, const std::string& animation) {
  const GltfBytes file = gltf_bytes(path, document::read_file(path, kLargestMeshFile));
  const Tree& gltf = *file.gltf;
  GltfScene scene{gltf_nodes(path, gltf), {}, {}, {}};
  scene.animations = gltf_animations(path, gltf, GltfBuffers(path, file.bytes, gltf), animation);
  const Tree& lights = at(at(at(gltf, "extensions"), "KHR_lights_punctual"), "lights");
  const std::vector<bool> in_scene = nodes_in_scene(gltf, scene.nodes.parents);
  for (std::size_t node = 0; node < in_scene.size(); ++node) {
    if (!in_scene[node]) continue;
    const Tree& tree = at(gltf, "nodes")[node];
    if (const Tree& camera = item(at(gltf, "cameras"), at(tree, "camera")); !camera.is_null())
      scene.cameras.push_back(camera_of(camera, node));
    const Tree& light = item(lights, at(at(at(tree, "extensions"), "KHR_lights_punctual"), "light"));
    if (light.is_null()) continue;
    if (const auto read = light_of(light, node))
      scene.lights.push_back(*read);
    else
      ++scene.unread_lights;
  }
  return scene;
}

}  // namespace mars::importer
