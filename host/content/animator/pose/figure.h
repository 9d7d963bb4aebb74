// A figure in motion: the frames of all joints of a model at a frame of the film, and from them the
// T-matrices of its segments. Joints turn relative to their parents, so limbs never come apart (thesis 3.4).
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "host/content/animator/pose/channel.h"
#include "host/content/animator/pose/rotation.h"
#include "host/content/modeler/frames.h"
#include "host/content/modeler/model.h"

namespace mars::animator {

// How a whole figure turns, by its "turn".
const modeler::Joint& free_joint();

// "turns 170 degrees about y, outside its limits 0 to 150", or "turns about y only; its x axis is locked at 0, not 20",
// if the pose breaks a limit.
std::optional<std::string> broken_limit(const modeler::Joint& joint, const glm::dvec3& pose);

// What an animator set for one figure.
struct FigureMotion {
  Channel<glm::dvec3> place;              // in the world, at least one key
  Channel<glm::dvec3> turn;               // degrees about x, y, z as a free joint's pose; at least one key
  std::vector<Channel<glm::dvec3>> pose;  // one a joint; without a key it rests
};

// The last frame at which anything of it has a key; 0 if nothing has.
std::uint32_t last_key(const FigureMotion& motion);

// A joint's turn over the frames. An ease that overshoots stops at the joint's limits, and so does a spline, on which
// the joint goes by its three numbers. Keeps the turn between the two
// keys it was last asked about.
class JointMotion {
 public:
  // Both must outlive it. `poses` may be empty.
  JointMotion(const modeler::Joint& joint, const Channel<glm::dvec3>& poses);
  JointMotion(const modeler::Joint&&, auto&&...) = delete;
  JointMotion(auto&&, const Channel<glm::dvec3>&&) = delete;

  glm::dmat3 at(std::uint32_t frame);

  // The pose that gives it: on a key the key's own; between keys that of pose_of(), which may leave the limits
  // of a joint with several freedoms; on a spline the spline's.
  glm::dvec3 pose_at(std::uint32_t frame);

 private:
  glm::dmat3 between(const Stretch& stretch);
  bool still(const Stretch& stretch) const;
  bool by_numbers(const Stretch& stretch) const;
  glm::dvec3 pose_by_numbers(const Stretch& stretch) const;
  glm::dmat3 turned(double part) const;
  double allowed(const Stretch& stretch, double key, double wanted) const;

  const modeler::Joint* joint_;
  const Channel<glm::dvec3>* poses_;
  std::size_t from_ = modeler::kNone;  // key at which the kept turn begins
  glm::dmat3 start_{1};
  Turn turn_{{1, 0, 0}, 0};
  double first_part_ = 0, last_part_ = 1;  // how far beyond the keys the limits let it go
};

// Where the whole figure stands by its own keys.
class OwnFrame {
 public:
  explicit OwnFrame(const FigureMotion& motion);  // must outlive it
  explicit OwnFrame(const FigureMotion&&) = delete;

  modeler::Axes at(std::uint32_t frame);

 private:
  const FigureMotion* motion_;
  JointMotion turn_;
};

// Plays a figure: frame by frame, in any order.
class Figure {
 public:
  // Both must outlive it.
  Figure(const modeler::Model& model, const FigureMotion& motion);
  Figure(const modeler::Model&&, auto&&...) = delete;
  Figure(auto&&, const FigureMotion&&) = delete;

  // Where its own keys place it, or where it is carried to. True if any joint now stands elsewhere than at the frame
  // before.
  bool move_to(std::uint32_t frame) { return move_to(frame, own_frame_.at(frame)); }
  bool move_to(std::uint32_t frame, const modeler::Axes& root);

  const modeler::Axes& frame_of(std::size_t joint) const { return frames_[joint]; }
  bool moved(std::size_t joint) const { return moved_[joint]; }  // by the last move_to
  bool still() const { return still_; }                          // has no two keys of anything

 private:
  void turn_keyed_joints(std::uint32_t frame);
  bool move_root(const modeler::Axes& root);

  const modeler::Model* model_;
  OwnFrame own_frame_;
  modeler::Axes root_;
  bool first_ = true;
  bool still_;
  std::vector<std::size_t> keyed_;    // joints with two keys or more
  std::vector<JointMotion> motions_;  // one a keyed joint
  std::vector<glm::dmat3> turns_;     // of all joints, against their parents
  std::vector<modeler::Axes> frames_;
  std::vector<char> moved_;
};

}  // namespace mars::animator
