#include "host/studio/stage/marks.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "host/content/animator/pose/camera_points.h"
#include "host/content/animator/pose/direction.h"
#include "host/content/document/text.h"
#include "host/content/elementary/elementary.h"
#include "host/content/modeler/frames.h"

namespace mars::studio {
namespace {

constexpr double kBulbPixels = 9, kRayPixels = 15, kBodyPixels = 22, kMarkArrowPixels = 60;
constexpr double kSunDistance = 1.5;  // radii of the subject
constexpr int kCircleSteps = 36;
constexpr double kMostShownAngle = 170;  // degrees, of a cone or field of view that is shown
constexpr const char* kMarkAxisNames[] = {"x", "y", "z"};

double half_width(const MarkState& state) {
  if (state.height > 0) return state.height / 2;
  const double distance = state.aim ? glm::length(*state.aim - state.place) : 0;
  return distance * elementary::tan(std::min(state.angle, kMostShownAngle) / 2 * modeler::kDegree);
}

// A unit vector across `axis`, towards `wanted` where that is not along it.
glm::dvec3 across(const glm::dvec3& axis, const glm::dvec3& wanted) {
  const glm::dvec3 part = wanted - glm::dot(wanted, axis) * axis;
  if (glm::length(part) > 1e-6) return glm::normalize(part);
  return across(axis, std::abs(axis.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0));
}

MarkState camera_state(const Project& project, const Moments& moments) {
  const wire::Camera& camera = moments.now().cameras.front();
  const Screen seen(camera, 2, 2);
  MarkState state{seen.eye()};
  state.aim = animator::at_at(project.film(), project.frame());
  state.side = seen.right();
  state.up = seen.up();
  state.shift = {camera.shift_x, camera.shift_y};
  if (camera.projection == wire::Projection::orthographic)
    state.height = 2 / camera.focal;
  else if (camera.projection == wire::Projection::perspective)
    state.angle = 2 * elementary::atan(1 / camera.focal) / modeler::kDegree;
  return state;
}

MarkState light_state(const animator::LightMotion& light, const Moments& moments, std::uint32_t frame) {
  MarkState state{};
  if (light.kind == wire::LightKind::directional) {
    const preview::Ball subject = moments.subject();
    state.far = true;
    state.center = subject.center;
    state.place = subject.center + kSunDistance * subject.radius * animator::direction_at(light.vector, frame);
    return state;
  }
  state.place = animator::value_at(light.vector, frame);
  if (!light.reach.empty()) state.reach = animator::value_at(light.reach, frame);
  if (light.kind != wire::LightKind::spot) return state;
  state.aim = animator::value_at(light.at, frame);
  const glm::dvec2 cone = animator::value_at(light.cone, frame);
  state.inner = cone.x;
  state.angle = cone.y;
  const glm::dvec3 way = *state.aim - state.place;
  const glm::dvec3 axis = glm::length(way) > 0 ? glm::normalize(way) : glm::dvec3(0, 0, -1);
  state.up = across(axis, {0, 0, 1});
  state.side = glm::cross(axis, state.up);
  return state;
}

class MarkMaker {
 public:
  MarkMaker(const Mark& mark, const MarkState& state, bool selected, const Screen& screen)
      : mark_(mark),
        state_(state),
        screen_(screen),
        name_(name_of(mark)),
        kind_(mark.light ? "light" : "camera"),
        selected_(selected),
        pixel_(1 / screen.scale_at(state.place)) {}

  std::vector<Handle> make(double aspect, Tool tool) {
    if (!mark_.light)
      add_camera(aspect);
    else if (state_.far)
      add_sun();
    else
      add_bulb();
    add_point(name_, state_.place, Grip{.what = Grip::What::plane, .mark = mark_});
    if (selected_) add_pulls(tool);
    return std::move(handles_);
  }

 private:
  void add_line(const std::vector<glm::dvec3>& places) {
    for (Polyline& line : screen_.polylines(places)) handles_.push_back(handle(name_, std::move(line)));
  }

  Handle handle(const std::string& id, Polyline points) const {
    Handle handle{id, kind_, std::move(points)};
    handle.selected = selected_;
    return handle;
  }

  void add_point(const std::string& id, const glm::dvec3& place, const Grip& grip) {
    const auto pixel = screen_.pixel_of(place);
    if (!pixel) return;
    handles_.push_back(handle(id, {*pixel}));
    handles_.back().grip = grip;
  }

  void add_circle(const glm::dvec3& center, const glm::dvec3& one, const glm::dvec3& other) {
    std::vector<glm::dvec3> circle;
    for (int step = 0; step <= kCircleSteps; ++step) {
      const double angle = 2 * std::numbers::pi * step / kCircleSteps;
      circle.push_back(center + elementary::cos(angle) * one + elementary::sin(angle) * other);
    }
    add_line(circle);
  }

  // In the plane parallel to the screen, by pixels.
  glm::dvec3 seen(double right, double up) const {
    return state_.place + pixel_ * (right * screen_.right() + up * screen_.up());
  }

  // Its body behind the eye, and what the film shows at the distance of what it looks at.
  void add_camera(double aspect) {
    const glm::dvec3 &eye = state_.place, ahead = glm::cross(state_.up, state_.side);
    const double body = kBodyPixels * pixel_;
    const auto corner = [&](int x, int y, double back) {
      return eye - back * body * ahead + 0.3 * body * (double(x) * state_.side + double(y) * state_.up);
    };
    const auto edge = [&](double back) {
      add_line(
          {corner(-1, -1, back), corner(1, -1, back), corner(1, 1, back), corner(-1, 1, back), corner(-1, -1, back)});
    };
    edge(0.2);
    edge(1);
    for (const int x : {-1, 1})
      for (const int y : {-1, 1}) add_line({corner(x, y, 0.2), corner(x, y, 1)});
    const glm::dvec3 up = half_width(state_) * state_.up, right = half_width(state_) * aspect * state_.side;
    const glm::dvec3 way = glm::length(*state_.aim - eye) * ahead;
    const glm::dvec3 middle = eye + way + 2 * state_.shift.x * right + 2 * state_.shift.y * up;
    const glm::dvec3 corners[] = {middle - right - up, middle + right - up, middle + right + up, middle - right + up};
    add_line({corners[0], corners[1], corners[2], corners[3], corners[0]});
    for (const glm::dvec3& far : corners) add_line({state_.height > 0 ? far - way : eye, far});
  }

  void add_sun() {
    add_circle(state_.place, kBulbPixels * pixel_ * screen_.right(), kBulbPixels * pixel_ * screen_.up());
    for (int ray = 0; ray < 8; ++ray) {
      const double angle = std::numbers::pi / 4 * ray, x = elementary::cos(angle), y = elementary::sin(angle);
      add_line({seen(1.25 * kBulbPixels * x, 1.25 * kBulbPixels * y), seen(kRayPixels * x, kRayPixels * y)});
    }
    add_line({state_.place, state_.center});
    const auto from = screen_.pixel_of(state_.place), to = screen_.pixel_of(state_.center);
    if (!from || !to || glm::length(*to - *from) < 1) return;
    const glm::dvec2 way = kBulbPixels * glm::normalize(*to - *from), side(-way.y, way.x);
    handles_.push_back(handle(name_, {*to - way + 0.5 * side, *to, *to - way - 0.5 * side}));
  }

  void add_bulb() {
    add_circle(state_.place, kBulbPixels * pixel_ * screen_.right(), kBulbPixels * pixel_ * screen_.up());
    for (const double down : {1.2, 1.5})
      add_line({seen(-0.5 * kBulbPixels, -down * kBulbPixels), seen(0.5 * kBulbPixels, -down * kBulbPixels)});
    if (state_.reach > 0) add_circle(state_.place, state_.reach * screen_.right(), state_.reach * screen_.up());
    if (!state_.aim) return;
    const glm::dvec3 up = half_width(state_) * state_.up, right = half_width(state_) * state_.side;
    add_circle(*state_.aim, right, up);
    for (const glm::dvec3& far : {right, -right, up, -up}) add_line({state_.place, *state_.aim + far});
  }

  void add_pulls(Tool tool) {
    if (state_.aim) add_point(name_ + ":at", *state_.aim, Grip{.what = Grip::What::plane, .mark = mark_, .aim = true});
    const Grip size{.what = Grip::What::size, .mark = mark_};
    if (state_.angle > 0 || state_.height > 0)
      add_point(name_ + (mark_.light         ? ":cone"
                         : state_.height > 0 ? ":height"
                                             : ":fov"),
                *state_.aim + half_width(state_) * state_.up, size);
    if (state_.reach > 0 && !state_.aim)
      add_point(name_ + ":reach", state_.place + state_.reach * screen_.right(), size);
    if (tool == Tool::none) return;
    add_arrows("arrow:", state_.place, false);
    if (state_.aim) add_arrows("at:", *state_.aim, true);
  }

  void add_arrows(const char* id, const glm::dvec3& from, bool aim) {
    const double length = kMarkArrowPixels / screen_.scale_at(from);
    for (int axis = 0; axis < 3; ++axis) {
      glm::dvec3 to = from;
      to[axis] += length;
      for (Polyline& line : screen_.polylines({from, to})) {
        Handle arrow{std::string(id) + kMarkAxisNames[axis], "arrow", std::move(line), kMarkAxisNames[axis]};
        arrow.grip = Grip{.what = Grip::What::arrow, .axis = axis, .mark = mark_, .aim = aim};
        handles_.push_back(std::move(arrow));
      }
    }
  }

  const Mark& mark_;
  const MarkState& state_;
  const Screen& screen_;
  std::string name_;
  const char* kind_;
  bool selected_;
  double pixel_;  // of the world, where the mark stands
  std::vector<Handle> handles_;
};

}  // namespace

bool there_is(const Project& project, const Mark& mark) {
  if (project.is_model()) return false;
  return !mark.light || (!project.rig_lights() && *mark.light < project.film().lights.size());
}

MarkState state_of(const Project& project, const Moments& moments, const Mark& mark) {
  if (!mark.light) return camera_state(project, moments);
  return light_state(project.film().lights[*mark.light], moments, project.frame());
}

std::string name_of(const Mark& mark) { return mark.light ? "light/" + std::to_string(*mark.light + 1) : "camera"; }

std::optional<Mark> mark_named(const std::string& name) {
  constexpr std::string_view kLight = "light/";
  if (name == "camera") return Mark{};
  if (!name.starts_with(kLight)) return std::nullopt;
  const auto number = document::number_in<std::uint32_t>(std::string_view(name).substr(kLight.size()));
  if (!number || *number == 0) return std::nullopt;
  return Mark{*number - 1};
}

std::vector<Handle> marks_of(const Project& project, const Moments& moments, const Selection& selection, Tool tool,
                             const Screen& screen) {
  if (project.is_model() || !moments.show_the_film()) return {};
  const animator::Film& film = project.film();
  std::vector<Mark> marks{Mark{}};
  if (!project.rig_lights())
    for (std::size_t light = 0; light < film.lights.size(); ++light) marks.push_back(Mark{light});
  std::vector<Handle> handles;
  for (const Mark& mark : marks) {
    const MarkState state = state_of(project, moments, mark);
    auto made =
        MarkMaker(mark, state, selection.mark == mark, screen).make(film.width * film.pixel_aspect / film.height, tool);
    std::ranges::move(made, std::back_inserter(handles));
  }
  return handles;
}

}  // namespace mars::studio
