#include "host/content/animator/motion/goals/seat.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <optional>

#include "hal/failure/failure.h"
#include "host/content/animator/motion/scene/rehearsal.h"
#include "host/content/animator/motion/goals/sitting.h"
#include "host/content/animator/motion/body/stance.h"
#include "host/content/animator/motion/gaits/steps.h"
#include "host/content/animator/motion/scene/target.h"
#include "host/content/elementary/elementary.h"

namespace mars::motion {
namespace {

constexpr double kOnSeat = 0.45;         // of the thigh, from the seat's edge to the hips
constexpr double kBesideHips = 0.2;      // of the leg, from the hips to the seat's end
constexpr double kNear = 0.12;           // of the leg: so near to where it should stand it stays
constexpr double kSeatAskew = 12;        // degrees
constexpr double kBackAboveSeat = 0.15;  // of the leg: what rises so far above a seat is a back or an arm
constexpr double kLowestSeat = 0.15, kHighestSeat = 0.95;  // of the leg: heights of seats
constexpr double kClearOfSeat = 0.12;                      // of the leg, between a way and the seat
constexpr double kAround = 0.4;                            // of the leg, from the seat's corners to who walks around it

glm::dvec2 flat(const glm::dvec3& v) { return {v.x, v.y}; }

// A seat from above.
struct Seat {
  glm::dvec2 middle;
  glm::dvec2 along;  // a unit vector
  glm::dvec2 half;   // along that and to its left
  double top;        // height in the world

  glm::dvec2 local(const glm::dvec2& place) const {
    return {glm::dot(place - middle, along), glm::dot(place - middle, left_of(along))};
  }
  glm::dvec2 world(const glm::dvec2& at) const { return middle + at.x * along + at.y * left_of(along); }
};

Seat seat_of(const Block& block) {
  int up = 2;
  for (int axis = 0; axis < 2; ++axis)
    if (std::abs(block.axes[axis].z) > std::abs(block.axes[up].z) + 1e-9) up = axis;
  const int first = (up + 1) % 3, second = (up + 2) % 3;
  return {flat(block.middle),
          glm::normalize(flat(block.axes[first])),
          {block.half[first], block.half[second]},
          block.top()};
}

// Where feet stand, and the way the figure looks, of one that sits on one side of the seat.
struct Spot {
  glm::dvec2 feet, looks;
  glm::dvec2 hips;
};

class Approach {
 public:
  Approach(const Scene& scene, const Body& body, const Seat& seat, double back)
      : scene_(scene), body_(body), seat_(seat), back_(back) {
    const Stance stance = stance_of(body, posture_of(scene));
    stands_ = flat(0.5 * (stance.feet[0].ankle + stance.feet[1].ankle));
  }

  // The shortest way to a side on which one can sit: opposite its back, else where nothing rises.
  std::vector<glm::dvec2> way(const Target& target, Spot& spot) const {
    std::vector<glm::dvec2> best;
    double least = 1e300;
    for (const glm::dvec2& side : sides_of(target)) {
      const Spot there = spot_at(side);
      const std::vector<glm::dvec2> around = around_to(there.feet);
      if (const double length = length_of(around); length < least) {
        least = length;
        best = around;
        spot = there;
      }
    }
    if (best.empty())
      throw Failure("'" + name_of(scene_.film, target) + "' has no free side to sit down on", scene_.where(),
                    "name the joint that is the seat, or another seat");
    return best;
  }

 private:
  std::vector<glm::dvec2> sides_of(const Target& target) const {
    std::vector<glm::dvec2> open, before_backs;
    for (const glm::dvec2 side : {glm::dvec2(1, 0), glm::dvec2(-1, 0), glm::dvec2(0, 1), glm::dvec2(0, -1)}) {
      if (is_closed(target, side)) continue;
      open.push_back(side);
      if (is_closed(target, -side)) before_backs.push_back(side);
    }
    return before_backs.empty() ? open : before_backs;
  }

  Spot spot_at(const glm::dvec2& side) const {
    const double leg = body_.leg_length();
    const int deep = side.x != 0 ? 0 : 1;
    const double inset = std::min(seat_.half[deep], kOnSeat * body_.legs[0].thigh);
    glm::dvec2 hips = side * (seat_.half[deep] - inset);
    const double free = std::max(0.0, seat_.half[1 - deep] - kBesideHips * leg);
    hips[1 - deep] = std::clamp(seat_.local(stands_)[1 - deep], -free, free);
    const glm::dvec2 looks = seat_.world(side) - seat_.middle;
    return {seat_.world(hips + back_ * side), looks, seat_.world(hips)};
  }

  // Backs and arms of seats: other parts of the actor that rise on that side.
  bool is_closed(const Target& target, const glm::dvec2& side) const {
    if (target.joint == modeler::kNone) return false;
    const modeler::Model& model = scene_.film.model_of(target.actor);
    for (std::size_t joint = 0; joint < model.joints.size(); ++joint) {
      if (joint == target.joint || !model.joints[joint].segment) continue;
      const Block part = block_of(scene_, {target.actor, joint}, scene_.at);
      if (part.top() < seat_.top + kBackAboveSeat * body_.leg_length()) continue;
      const glm::dvec2 at = seat_.local(flat(part.middle)) / seat_.half;
      if (glm::dot(at, side) > 0.6) return true;
    }
    return false;
  }

  bool is_free(const glm::dvec2& from, const glm::dvec2& to) const {
    const glm::dvec2 half = seat_.half + kClearOfSeat * body_.leg_length();
    for (int i = 0; i <= 64; ++i) {
      const glm::dvec2 at = seat_.local(from + i / 64.0 * (to - from));
      if (std::abs(at.x) < half.x && std::abs(at.y) < half.y) return false;
    }
    return true;
  }

  // Straight, or by one or two corners.
  std::vector<glm::dvec2> around_to(const glm::dvec2& to) const {
    if (is_free(stands_, to)) return {to};
    const glm::dvec2 half = seat_.half + kAround * body_.leg_length();
    const glm::dvec2 corners[] = {half, {-half.x, half.y}, -half, {half.x, -half.y}};
    std::vector<glm::dvec2> best{to};
    double least = 1e300;
    for (int first = 0; first < 4; ++first)
      for (const int turn : {0, 1, 3}) {
        const glm::dvec2 one = seat_.world(corners[first]), other = seat_.world(corners[(first + turn) % 4]);
        if (!is_free(stands_, one) || !is_free(one, other) || !is_free(other, to)) continue;
        const std::vector<glm::dvec2> way = turn == 0 ? std::vector{one, to} : std::vector{one, other, to};
        if (const double length = length_of(way); length < least) {
          least = length;
          best = way;
        }
      }
    return best;
  }

  double length_of(const std::vector<glm::dvec2>& way) const {
    double sum = 0;
    glm::dvec2 from = stands_;
    for (const glm::dvec2& to : way) {
      sum += glm::distance(from, to);
      from = to;
    }
    return sum;
  }

  const Scene& scene_;
  const Body& body_;
  const Seat& seat_;
  double back_;
  glm::dvec2 stands_;
};

std::vector<std::string> numbers(const glm::dvec2& v) {
  return {document::shown(animator::rounded(v.x)), document::shown(animator::rounded(v.y))};
}

// Of an actor of which no joint is named: the largest top at a height for sitting.
Target seat_part(const Scene& scene, const Target& target, const Body& body) {
  if (target.joint != modeler::kNone) return target;
  const modeler::Model& model = scene.film.model_of(target.actor);
  const double floor = body.floor_under(posture_of(scene));
  Target best = target;
  double most = 0;
  for (std::size_t joint = 0; joint < model.joints.size(); ++joint) {
    if (!model.joints[joint].segment) continue;
    const Seat seat = seat_of(block_of(scene, {target.actor, joint}, scene.at));
    const double height = (seat.top - floor) / body.leg_length();
    if (height < kLowestSeat || height > kHighestSeat || seat.half.x * seat.half.y <= most) continue;
    most = seat.half.x * seat.half.y;
    best.joint = joint;
  }
  return best;
}

Motion sit_on(const Scene& scene, const Target& named) {
  for (const char* other : {"seat-height", "back"})
    if (scene.arguments.has(other)) scene.arguments.refuse(other, "stands beside on", "the seat says it: leave it out");
  const Body body = body_of(scene.model(), scene.actor.name, "sit");
  const Target target = seat_part(scene, named, body);
  const Seat seat = seat_of(block_of(scene, target, scene.at));
  const double height = seat.top - body.floor_under(posture_of(scene));
  if (height <= 0)
    throw Failure("'" + name_of(scene.film, target) + "' is not above the floor on which it stands", scene.where(),
                  "name a higher seat");
  Spot spot{};
  const std::vector<glm::dvec2> way = Approach(scene, body, seat, hips_behind(scene, height)).way(target, spot);
  Rehearsal rehearsal(scene);
  const auto stance = [&] { return stance_of(body, posture_of(rehearsal.scene(scene.arguments))); };
  const auto feet = [&] {
    const Stance now = stance();
    return flat(0.5 * (now.feet[0].ankle + now.feet[1].ankle));
  };
  if (way.size() > 1 || glm::distance(feet(), way.back()) > kNear * body.leg_length())
    for (const glm::dvec2& to : way) rehearsal.perform(walk, {{"to", numbers(to)}});
  const double heading = glm::degrees(elementary::atan2(spot.looks.y, spot.looks.x));
  if (std::abs(std::remainder(heading - stance().heading, 360.0)) > kSeatAskew)
    rehearsal.perform(turn, {{"to", numbers(feet() + 100 * body.leg_length() * spot.looks)}});
  const double looking = glm::radians(stance().heading);
  const double back = glm::dot(feet() - spot.hips, glm::dvec2(elementary::cos(looking), elementary::sin(looking)));
  Arguments::Values values{{"seat-height", {document::shown(height)}},
                           {"back", {document::shown(std::max(0.0, back))}}};
  if (scene.arguments.has("seconds")) values["seconds"] = scene.arguments.values("seconds");
  rehearsal.perform(sit_down, values);
  return rehearsal.take();
}

}  // namespace

Motion sit(const Scene& scene) {
  const auto on = target_of(scene, "on");
  return on ? sit_on(scene, *on) : sit_down(scene);
}

}  // namespace mars::motion
