// A joint: where it stands in its parent's frame, how far it turns, and the base segment that it moves.
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
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "node/wire/film_parts.h"

namespace mars::modeler {

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

// An affine map, x' = turn x + place; `turn` may scale and shear.
struct Affine {
  glm::dmat3 turn{1};
  glm::dvec3 place{0, 0, 0};

  bool operator==(const Affine&) const = default;
};

// A bone of a skin: vertices that follow it alone go by the joint's frame times `bind`, from the frame of the segment's
// joint at rest.
struct Bone {
  std::size_t joint;  // index into the model's joints
  Affine bind;
};

struct Segment {
  std::size_t shape;  // index into the model's shapes
  Box sbb;
  std::string material;       // of the model, else of the film; "": the default one
  std::vector<Bone> bones{};  // of a skin, ascending by joint: the mesh's vertices have their numbers; else none
  wire::Blend blend = wire::Blend::linear;  // of a skin
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

// Whether the joint is `above`, or hangs below it; false if there is no `above` (kNone).
bool is_at_or_below(std::span<const Joint> joints, std::size_t joint, std::size_t above);

}  // namespace mars::modeler
