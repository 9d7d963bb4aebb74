#include "host/studio/stage/mouse_way.h"

namespace mars::studio {
namespace {

constexpr double kFine = 0.2;  // of the mouse's way

}  // namespace

void MouseWay::follow(const glm::dvec2& mouse, bool fine) {
  at_ += (fine ? kFine : 1.0) * (mouse - mouse_);
  mouse_ = mouse;
}

std::optional<glm::dvec3> MouseWay::along(const glm::dvec3& from, const glm::dvec3& way) const {
  const auto first = nearest_along(screen_.ray_through(began_), from, way);
  const auto now = nearest_along(screen_.ray_through(at_), from, way);
  if (!first || !now) return std::nullopt;
  return (*now - *first) * way;
}

std::optional<glm::dvec3> MouseWay::across(const glm::dvec3& from) const {
  const auto first = on_plane(screen_.ray_through(began_), from, screen_.ahead());
  const auto now = on_plane(screen_.ray_through(at_), from, screen_.ahead());
  if (!first || !now) return std::nullopt;
  return *now - *first;
}

}  // namespace mars::studio
