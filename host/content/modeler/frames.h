// Where joints and base segments stand: the one place where a pose becomes a frame and a frame a T-matrix
// (model.h has the formulas).
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "host/content/modeler/model.h"

namespace mars::modeler {

// Where a joint stands in the world: p' = turn p + place.
struct Axes {
  glm::dmat3 turn{1};
  glm::dvec3 place{0, 0, 0};
};

inline constexpr double kDegree = std::numbers::pi / 180;  // radians

// About `axis`, a unit vector, by an angle in radians: cos I + (1 - cos) n n^T + sin N.
glm::dmat3 rotation(const glm::dvec3& axis, double angle);

// In degrees; quarter turns are exact.
glm::dmat3 rotation_by_degrees(const glm::dvec3& axis, double degrees);

// A joint's turn against its parent for a pose in degrees: Rot(x, a) Rot(y, b) Rot(z, c).
glm::dmat3 orientation(const Joint& joint, const glm::dvec3& pose);

// [X Y Z]: the axes of the base segment, skewed or not.
glm::dmat3 segment_axes(const Joint& joint);

// The base segment's box-scaled coordinates to the world: F [X Y Z].
Axes segment_frame(const Axes& joint_frame, const Joint& joint);

// Back from that: the frame of the joint whose segment stands at `segment`, which may be scaled and sheared.
Axes joint_frame(const Axes& segment, const Joint& joint);

// What `inner` leads to, by `outer`; and the way back, of a map that has one.
Affine product(const Affine& outer, const Affine& inner);
Affine inverse(const Affine& map);

// A skin's bind that leaves the segment, which `joint` moves, where it is while both stand in these frames.
Affine bind_at_rest(const Axes& bone, const Axes& joint);

// The T-matrix of a bone whose joint stands at `frame`.
wire::Matrix bone_matrix(const Axes& frame, const Bone& bone, const Joint& joint);

// The T-matrix, from the unit cube: `frame` after scaling into `sbb`.
wire::Matrix t_matrix(const Axes& frame, const Box& sbb);

// Of every joint, in the model's own frame, with all joints at rest.
std::vector<Axes> rest_frames(const Model& model);

// The least boxes around each joint's surface at rest, true to a thousandth; none where a joint has no segment.
std::vector<std::optional<Box>> segment_rest_bounds(const Model& model);

// The least box around all of them; none: no joint has a segment.
std::optional<Box> rest_bounds(const Model& model);

}  // namespace mars::modeler
