#include "host/studio/stage/handles.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "host/content/animator/pose/axis_turn.h"
#include "host/content/elementary/elementary.h"
#include "host/content/modeler/bent_skin.h"
#include "host/content/modeler/frames.h"
#include "host/studio/stage/reach_place.h"

namespace mars::studio {
namespace {

constexpr double kRingPixels[] = {84, 72, 60};  // radii of x, y, z
constexpr double kHandleArrowPixels = 80;
constexpr double kTickPixels = 9;   // of a limit, each way
constexpr double kStepDegrees = 5;  // of an arc
constexpr double kReachPixels = 7;  // from a line
constexpr double kNearPixels = 9;   // from a place, which is before lines
constexpr std::size_t kMostPointHandles = 4000;
constexpr const char* kAxisNames[] = {"x", "y", "z"};

glm::dvec3 unit(int axis) {
  glm::dvec3 vector(0);
  vector[axis] = 1;
  return vector;
}

std::string shown_angle(double degrees) {
  const double rounded = std::round(degrees * 10) / 10 + 0.0;
  return document::shown(rounded) + "\u00b0";
}

class HandleMaker {
 public:
  HandleMaker(const Project& project, const Selection& selection, const Screen& screen)
      : project_(project), selection_(selection), screen_(screen) {}

  std::vector<Handle> make(Tool tool, RingAxes axes) {
    if (tool == Tool::none || !selection_.actor) return {};
    add_joints();
    const auto posed = studio::posed(project_, selection_);
    if (tool == Tool::turn && posed) add_rings(*posed, axes);
    if (tool == Tool::move && posed) add_arrows(*posed);
    if (tool == Tool::reach) add_reach();
    if (tool == Tool::box && project_.is_model()) add_box();
    if (tool == Tool::points && project_.is_model()) add_points();
    return std::move(handles_);
  }

 private:
  void add_line(Handle handle, const std::vector<glm::dvec3>& places) {
    for (Polyline& line : screen_.polylines(places)) {
      handle.points = std::move(line);
      handles_.push_back(handle);
    }
  }

  void add_place(Handle handle, const glm::dvec3& place) {
    const auto pixel = screen_.pixel_of(place);
    if (!pixel) return;
    handle.points = {*pixel};
    handles_.push_back(std::move(handle));
  }

  void add_joints() {
    const auto& joints = project_.film().model_of(*selection_.actor).joints;
    const animator::ActorState state = animator::state_at(project_.film(), *selection_.actor, project_.frame());
    for (std::size_t joint = 0; joint < state.joints.size(); ++joint) {
      Handle handle{"joint:" + joints[joint].name, "joint", {}};
      handle.text = joints[joint].name;
      handle.selected = selection_.joint == joint || std::ranges::count(selection_.more, joint) > 0;
      add_place(std::move(handle), state.joints[joint].place);
    }
  }

  void add_rings(const Posed& posed, RingAxes chosen) {
    for (int number = 0; number < 3; ++number)
      if (has_ring(*posed.joint, number, chosen))
        add_ring(posed.axis(number, ring_axes_of(*posed.joint, chosen)), number);
  }

  void add_ring(const TurnAxis& axis, int number) {
    const double pixel = 1 / screen_.scale_at(axis.center), radius = kRingPixels[number] * pixel;
    const glm::dvec3 across = glm::cross(axis.axis, axis.zero);
    const auto at = [&](double degrees, double far) {
      const double angle = degrees * modeler::kDegree;
      return axis.center + far * (elementary::cos(angle) * axis.zero + elementary::sin(angle) * across);
    };
    const bool whole = axis.limits.upper - axis.limits.lower >= 360;
    const double from = whole ? 0 : axis.limits.lower, to = whole ? 360 : axis.limits.upper;
    std::vector<glm::dvec3> arc;
    const int steps = std::max(1, static_cast<int>(std::ceil((to - from) / kStepDegrees)));
    for (int step = 0; step <= steps; ++step) arc.push_back(at(from + (to - from) * step / steps, radius));
    const std::string name = kAxisNames[number], id = "ring:" + name;
    add_line({id, "ring", {}, name, "", Grip{Grip::What::ring, number}}, arc);
    const double tick = kTickPixels * pixel;
    if (!whole)
      for (const double limit : {from, to})
        add_line({"limit:" + name, "limit", {}, name, shown_angle(limit)},
                 {at(limit, radius - tick), at(limit, radius + tick)});
    add_place({"label:" + name, "label", {}, name, axis.angle ? name + " " + shown_angle(*axis.angle) : name},
              at(axis.angle.value_or(0), radius));
  }

  // A model's joint is moved along its parent's axes, a film's actor along the world's.
  void add_arrows(const Posed& posed) {
    if (project_.is_model() && !selection_.joint) return;
    if (project_.is_model()) return add_arrows(posed.center, posed.parent.turn);
    const animator::ActorState state = animator::state_at(project_.film(), *selection_.actor, project_.frame());
    add_arrows(state.place, glm::dmat3(1));
  }

  void add_reach() {
    if (const auto place = reach_place(project_, selection_)) add_arrows(*place, glm::dmat3(1));
  }

  void add_arrows(const glm::dvec3& from, const glm::dmat3& ways) {
    const double length = kHandleArrowPixels / screen_.scale_at(from);
    for (int axis = 0; axis < 3; ++axis)
      add_line(
          {std::string("arrow:") + kAxisNames[axis], "arrow", {}, kAxisNames[axis], "", Grip{Grip::What::arrow, axis}},
          {from, from + length * ways[axis]});
    add_place({"plane", "point", {}, "", "", Grip{Grip::What::plane}}, from);
  }

  void add_box() {
    const auto frame = segment_frame_of(project_, selection_);
    if (!frame) return;
    const modeler::Box& sbb = project_.film().model_of(*selection_.actor).joints[*selection_.joint].segment->sbb;
    const auto at = [&](const glm::dvec3& part) {
      return frame->turn * (sbb.min + part * (sbb.max - sbb.min)) + frame->place;
    };
    for (int corner = 0; corner < 8; ++corner)
      for (int axis = 0; axis < 3; ++axis) {
        if (corner >> axis & 1) continue;
        const glm::dvec3 from(corner & 1, corner >> 1 & 1, corner >> 2);
        add_line({"box", "box", {}}, {at(from), at(from + unit(axis))});
      }
    for (int axis = 0; axis < 3; ++axis)
      for (int side = 0; side < 2; ++side) {
        glm::dvec3 part(0.5);
        part[axis] = side;
        Handle handle{std::string("face:") + kAxisNames[axis] + (side == 0 ? "-" : "+"), "box", {}, kAxisNames[axis]};
        handle.grip = Grip{Grip::What::face, axis, side};
        add_place(std::move(handle), at(part));
      }
  }

  // Of points of several patches that are at one place, the first.
  void add_points() {
    if (!selection_.joint) return;
    const modeler::Model& model = project_.film().model_of(*selection_.actor);
    const auto& segment = model.joints[*selection_.joint].segment;
    if (!segment) return;
    const animator::ActorState state = animator::state_at(project_.film(), *selection_.actor, project_.frame());
    const modeler::Shape& shape = model.shapes[segment->shape];
    std::set<std::array<float, 3>> seen;
    const auto add = [&](std::size_t patch, std::size_t number, std::size_t columns, const auto& point) {
      if (seen.size() >= kMostPointHandles || !seen.insert(point).second) return;
      Handle handle{"point:" + std::to_string(patch) + ":" + std::to_string(number), "point", {}};
      handle.grip = Grip{Grip::What::point, 0, 0, patch, number % columns, number / columns};
      const wire::Matrix matrix = matrix_of_point(model, *selection_.joint, state, *handle.grip);
      glm::dvec3 place;
      for (int row = 0; row < 3; ++row) {
        const auto& m = matrix.m[static_cast<std::size_t>(row)];
        place[row] = m[0] * point[0] + m[1] * point[1] + m[2] * point[2] + m[3];
      }
      add_place(std::move(handle), place);
    };
    if (shape.net)
      for (std::size_t number = 0; number < shape.net->points.size(); ++number)
        add(0, number, shape.net->columns, shape.net->points[number]);
    else
      for (std::size_t patch = 0; patch < shape.patches.size(); ++patch)
        for (std::size_t number = 0; number < 16; ++number) add(patch, number, 4, shape.patches[patch].points[number]);
  }

  const Project& project_;
  const Selection& selection_;
  const Screen& screen_;
  std::vector<Handle> handles_;
};

}  // namespace

wire::Matrix matrix_of_point(const modeler::Model& model, std::size_t joint, const animator::ActorState& state,
                             const Grip& point) {
  const modeler::Segment& segment = *model.joints[joint].segment;
  const modeler::Shape& shape = model.shapes[segment.shape];
  if (!shape.net) return state.segments[joint].value();
  return modeler::BentSkin(state.bones[joint], segment.blend)
      .matrix_of(shape.net->bones[shape.net->columns * point.j + point.i]);
}

RingAxes ring_axes_of(const modeler::Joint& joint, RingAxes chosen) {
  return joint.freedoms() < 2 ? RingAxes::numbers : chosen;
}

// The axes of others are no axes of the joint, which may be locked.
bool has_ring(const modeler::Joint& joint, int axis, RingAxes chosen) {
  const RingAxes axes = ring_axes_of(joint, chosen);
  const bool of_others = axes == RingAxes::parent || axes == RingAxes::world;
  return of_others || joint.limits[static_cast<std::size_t>(axis)].free();
}

TurnAxis Posed::axis(int number, RingAxes axes) const {
  const bool by_number = axes == RingAxes::numbers;
  glm::dvec3 turned = pose;
  if (by_number)
    for (int i = number; i < 3; ++i) turned[i] = 0;  // only the numbers before this one count
  const auto way = [&](int i) {
    if (axes == RingAxes::world) return unit(i);
    return parent.turn * (axes == RingAxes::parent ? unit(i) : animator::present_axis(*joint, turned, i));
  };
  const glm::dvec3 axis = way(number), next = way((number + 1) % 3);
  const glm::dvec3 zero = glm::normalize(next - glm::dot(next, axis) * axis);
  if (!by_number) return {center, axis, zero, std::nullopt, {}};
  return {center, axis, zero, pose[number], joint->limits[static_cast<std::size_t>(number)]};
}

std::optional<Posed> posed(const Project& project, const Selection& selection) {
  if (!selection.actor) return std::nullopt;
  const animator::ActorState state = animator::state_at(project.film(), *selection.actor, project.frame());
  if (state.joints.empty()) return std::nullopt;
  const modeler::Axes root{modeler::orientation(animator::free_joint(), state.turn), state.place};
  if (!selection.joint) return Posed{&animator::free_joint(), {glm::dmat3(1), {0, 0, 0}}, state.place, state.turn};
  const modeler::Joint& joint = project.film().model_of(*selection.actor).joints[*selection.joint];
  const modeler::Axes& parent = joint.parent == modeler::kNone ? root : state.joints[joint.parent];
  return Posed{&joint, parent, state.joints[*selection.joint].place, state.pose[*selection.joint]};
}

std::optional<modeler::Axes> segment_frame_of(const Project& project, const Selection& selection) {
  if (!selection.actor || !selection.joint) return std::nullopt;
  const modeler::Joint& joint = project.film().model_of(*selection.actor).joints[*selection.joint];
  const animator::ActorState state = animator::state_at(project.film(), *selection.actor, project.frame());
  if (!joint.segment || state.joints.empty()) return std::nullopt;
  return modeler::segment_frame(state.joints[*selection.joint], joint);
}

std::vector<Handle> handles_of(const Project& project, const Selection& selection, Tool tool, RingAxes axes,
                               const Screen& screen) {
  return HandleMaker(project, selection, screen).make(tool, axes);
}

double ring_pixels(int axis) { return kRingPixels[axis]; }

const Handle* handle_at(const std::vector<Handle>& handles, const glm::dvec2& pixel) {
  const Handle* nearest = nullptr;
  double least = 1;
  for (const Handle& handle : handles) {
    if (!handle.grip) continue;
    const bool place = handle.points.size() == 1;
    const double distance = distance_to(handle.points, pixel) / (place ? kNearPixels : kReachPixels);
    const double rank = place ? distance / 2 : (distance + 1) / 2;  // places are before lines
    if (distance > 1 || rank > least) continue;
    nearest = &handle;
    least = rank;
  }
  return nearest;
}

Json described(const std::vector<Handle>& handles, const std::string& hot) {
  Json shapes = Json::array();
  for (const Handle& handle : handles) {
    const double parts = handle.fine ? 100 : 10;  // of a pixel
    Json points = Json::array();
    for (const glm::dvec2& point : handle.points)
      points.push_back({std::round(point.x * parts) / parts, std::round(point.y * parts) / parts});
    Json shape{{"id", handle.id}, {"kind", handle.kind}, {"points", std::move(points)}};
    if (!handle.axis.empty()) shape["axis"] = handle.axis;
    if (!handle.text.empty()) shape["text"] = handle.text;
    if (handle.grip && handle.id == hot) shape["hot"] = true;
    if (handle.selected) shape["selected"] = true;
    shapes.push_back(std::move(shape));
  }
  return shapes;
}

}  // namespace mars::studio
