// Angles that a person tries: of joints, by their names, before they are keys of a film file.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/content/animator/pose/film.h"
#include "host/preview/film_drawing.h"

namespace mars::preview {

class PoseUnderWay {
 public:
  // Degrees about x, y and z; what is none stays as the film has it.
  using Angles = std::array<std::optional<double>, 3>;

  // By the names of actor and joint.
  using ByNames = std::map<std::pair<std::string, std::string>, Angles>;

  bool empty() const { return angles_.empty(); }
  void clear();
  // Goes up with each change.
  std::uint64_t number() const { return number_; }
  const ByNames& angles() const { return angles_; }

  // How the joint stands at the frame, within its limits.
  glm::dvec3 pose_at(const animator::Film& film, const JointNumber& joint, std::uint32_t frame) const;
  void set(const animator::Film& film, const JointNumber& joint, int axis, double degrees);
  // Those that are still so.
  void leave_out(const ByNames& angles);
  // Leaves out joints that the film does not have.
  void keep_those_of(const animator::Film& film);

  // The figures that it changes, and those that they carry.
  std::map<std::size_t, animator::ActorState> figures(animator::Film& film, std::uint32_t frame) const;

 private:
  ByNames angles_;
  std::uint64_t number_ = 0;
};

// The film has the pose at the frame as long as this lives.
class PosedFilm {
 public:
  PosedFilm(animator::Film& film, const PoseUnderWay& pose, std::uint32_t frame);
  ~PosedFilm();
  PosedFilm(const PosedFilm&) = delete;
  PosedFilm& operator=(const PosedFilm&) = delete;

 private:
  std::vector<std::pair<animator::Channel<glm::dvec3>*, animator::Channel<glm::dvec3>>> before_;
};

// The joint with the names `names`, if the film has it and keys can move it.
std::optional<JointNumber> joint_named(const animator::Film& film, const std::pair<std::string, std::string>& names);

}  // namespace mars::preview
