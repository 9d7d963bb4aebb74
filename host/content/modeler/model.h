// A model: a tree of joints, each with at most one base segment. What a model file holds, with names resolved
// and primitives made into patches.
//
// Frames. At rest a joint's frame is parallel to its parent's; place and axes are vectors in the parent's
// frame. A pose (a, b, c), in degrees, turns it by R = Rot(x, a) Rot(y, b) Rot(z, c) about the unit axes as
// already turned (column vectors), z along x cross y. So F = F_parent * translate(place) * R, and children
// are never sheared. The base segment's T-matrix is F * [X Y Z] * (unit cube to sbb), where X and Y are the
// unit axes and Z = X x Y: skewed axes shear it (thesis 2.3). Limits bound exactly the three numbers of the
// pose.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "host/content/modeler/limbs.h"
#include "host/content/modeler/mesh.h"
#include "node/wire/film.h"

namespace mars::host {

inline constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

// Degrees. Equal: no freedom about this axis.
struct Limits {
  double lower = -180;
  double upper = 180;

  bool free() const { return lower < upper; }
};

// The segment bounding box; min < max in every coordinate.
struct Box {
  glm::dvec3 min{0, 0, 0};
  glm::dvec3 max{1, 1, 1};

  bool operator==(const Box&) const = default;
};

// `box` where it is flat one unit thick, with what is flat on its lower side.
Box thickened(Box box);

// Patches or a mesh in the unit cube, shared by all segments that name them.
struct Shape {
  std::string name;
  std::vector<node::Patch> patches;
  std::optional<Mesh> mesh{};
};

struct Segment {
  std::size_t shape;  // index into the model's shapes
  Box sbb;
  std::string material;  // of the model, else of the film; "": the default one
};

struct Joint {
  std::string name;
  std::size_t parent = kNone;  // index of a joint before this one; kNone: it stands in the model's own frame
  glm::dvec3 place{0, 0, 0};
  glm::dvec3 x_axis{1, 0, 0};  // unit vectors, not parallel
  glm::dvec3 y_axis{0, 1, 0};
  std::array<Limits, 3> limits;
  std::optional<Segment> segment;

  glm::dvec3 rest() const;  // the pose nearest to zero that the limits allow
  int freedoms() const;     // axes about which it can turn
};

struct NamedMaterial {
  std::string name;
  node::Material material;
};

struct Model {
  std::vector<Joint> joints;
  std::vector<Shape> shapes;
  std::vector<NamedMaterial> materials;
  Limbs limbs{};
};

inline constexpr node::Material kDefaultMaterial{{0.8f, 0.8f, 0.8f}, 0.10f, 0.65f, 0.45f, 32, 2};

}  // namespace mars::host
