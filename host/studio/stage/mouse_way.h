// The way of the mouse in one gesture, and what it is in the world of the view as it was when the gesture began.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "host/studio/stage/screen.h"

namespace mars::studio {

class MouseWay {
 public:
  MouseWay(const Screen& screen, const glm::dvec2& mouse) : screen_(screen), began_(mouse), mouse_(mouse), at_(mouse) {}

  // Where the page says that it is. `fine`: it goes a fifth of the way.
  void follow(const glm::dvec2& mouse, bool fine);

  const Screen& screen() const { return screen_; }
  const glm::dvec2& began() const { return began_; }
  const glm::dvec2& at() const { return at_; }  // slower than the mouse where it was fine

  // How what stands at `from` moves by it along `way` alone, or in the plane parallel to the screen. None: the view
  // does not tell.
  std::optional<glm::dvec3> along(const glm::dvec3& from, const glm::dvec3& way) const;
  std::optional<glm::dvec3> across(const glm::dvec3& from) const;

 private:
  Screen screen_;
  glm::dvec2 began_, mouse_, at_;
};

}  // namespace mars::studio
