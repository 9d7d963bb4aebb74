// Animations of glTF, evaluated by glTF 2.0's formulas (3.11, appendix C) in double precision: where every node is at a
// time.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <optional>
#include <string>
#include <vector>

#include "host/content/importer/gltf/gltf_numbers.h"

namespace mars::importer {

// A node's own T R S; of a node that has a matrix, that, and it is not animated.
struct GltfPlace {
  glm::dvec3 translation{0};
  glm::dquat rotation{1, 0, 0, 0};  // w, x, y, z
  glm::dvec3 scale{1};
  std::optional<glm::dmat4> matrix;

  glm::dmat4 local() const;
};

enum class GltfPath { translation, rotation, scale };
enum class GltfWay { step, linear, cubic };

struct GltfChannel {
  std::size_t node;
  GltfPath path;
  GltfWay way;
  std::vector<double> times;  // ascending
  GltfNumbers values;         // one a time; of cubic ones in-tangent, value, out-tangent

  // Before the first time and after the last it holds; a step is taken at its time but for what single precision
  // leaves. Of a rotation x, y, z, w, of length 1.
  std::array<double, 4> at(double time) const;
};

struct GltfAnimation {
  std::string name;
  std::vector<GltfChannel> channels;
  std::size_t weights = 0;  // channels of morph targets, which are not read
  std::size_t others = 0;   // channels of what is no node

  double end() const;  // seconds
};

// That of a file and the names of the others that it has.
struct GltfAnimations {
  std::optional<GltfAnimation> shown;  // none: the file has none
  std::vector<std::string> others;
};

struct GltfNodes {
  std::vector<GltfPlace> places;
  std::vector<std::size_t> parents;  // modeler::kNone of a node that stands on no other
};

// Which of the animations `names` is `name`, or the first where that is ""; none of a file without any. Refuses a file
// without it, in a failure that names those that there are.
std::optional<std::size_t> shown_animation(const std::filesystem::path& path, const std::vector<std::string>& names,
                                           const std::string& name);

// Refuses nodes that are below themselves.
GltfNodes gltf_nodes(const std::filesystem::path& path, const Tree& gltf);

// With shown_animation(). Refuses channels whose numbers cannot be read.
GltfAnimations gltf_animations(const std::filesystem::path& path, const Tree& gltf, const GltfBuffers& buffers,
                               const std::string& name);

// The nodes' own places at a time.
GltfNodes moved(GltfNodes nodes, const GltfAnimation& animation, double time);

// By node: from its axes to the file's.
std::vector<glm::dmat4> gltf_matrices(const GltfNodes& nodes);

}  // namespace mars::importer
