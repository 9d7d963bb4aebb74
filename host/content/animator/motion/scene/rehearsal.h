// Actions one after another, of one figure and of what it handles, as one Motion: each begins in the film as those
// before have left it. The film itself stays as it is.
#pragma once

#include <string>

#include "host/content/animator/motion/scene/scene.h"

namespace mars::motion {

class Rehearsal {
 public:
  explicit Rehearsal(const Scene& scene);  // which must outlive it
  explicit Rehearsal(const Scene&&) = delete;

  const animator::Film& film() const { return film_; }
  std::uint32_t at() const { return at_; }  // where the figure's next action begins

  // The figure as it is at at(), for a function that needs a Scene; for as long as nothing is added.
  Scene scene(const Arguments& arguments) const;
  void perform(Motion (*action)(const Scene& scene), Arguments::Values values);
  // Keys of the figure up to a frame, which is where the next action begins.
  void add(const Motion& motion);

  // What carries another actor from a frame on, or nothing, and its place and turn there, as it is or as it was.
  void attach(std::size_t actor, std::uint32_t frame, const animator::AttachKey& to);
  // Another actor's own action, from a frame on; it does not count for at().
  void perform(std::size_t actor, std::uint32_t frame, Motion (*action)(const Scene& scene), Arguments::Values values);

  const Motion& motion() const { return motion_; }
  Motion take() { return std::move(motion_); }

 private:
  const Scene& begin_;
  animator::Film film_;
  std::size_t actor_;
  std::uint32_t at_;
  Motion motion_;
};

}  // namespace mars::motion
