// Turns, places and the camera changed in a film that is open, for as long as a gesture goes on: only the keys around
// one frame, whatever the size of the film.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "host/content/animator/film.h"
#include "host/studio/project/step.h"

namespace mars::studio {

// The actor's number; without a name that of the only one. Throws Failure where there is none, or matrices move it.
std::size_t actor_named(const animator::Film& film, const std::string& name);
std::size_t joint_named(const modeler::Model& model, const std::string& name);

// Throws where another actor carries it at the frame: its own place and turn then count for nothing.
void refuse_carried(const animator::Film& film, std::size_t actor, std::uint32_t frame);

// Throws Failure where there is no such light, or it has no such part.
void check_light(const animator::Film& film, bool rig_lights, const LightStep& step);

class FilmGesture {
 public:
  // `rig_lights`: the film has no lights of its own, they go with the camera. What the film shows at the frame is then
  // what it will show when the step is done. What an earlier one shows is taken back.
  void show(animator::Film& film, bool rig_lights, const FigureStep& step, std::uint32_t frame);
  void show(animator::Film& film, bool rig_lights, const CameraStep& step, std::uint32_t frame);
  void show(animator::Film& film, bool rig_lights, const LightStep& step, std::uint32_t frame);

  // Of the same film, which has not been replaced since.
  void take_back(animator::Film& film);

  bool shows() const { return shows_; }
  const std::set<std::size_t>& actors() const { return actors_; }

 private:
  template <typename Value>
  struct Saved {
    animator::Channel<Value>* channel;
    animator::Channel<Value> was;
  };

  void set(animator::Channel<glm::dvec3>& channel, const glm::dvec3& value, std::uint32_t frame,
           const glm::dvec3& rest = {});

  std::vector<Saved<glm::dvec3>> vectors_;
  std::vector<Saved<animator::Point>> points_;
  std::vector<Saved<double>> numbers_;
  std::vector<animator::LightMotion> lights_;  // as they were, if the gesture has changed them
  std::set<std::size_t> actors_;
  bool shows_ = false;
};

}  // namespace mars::studio
