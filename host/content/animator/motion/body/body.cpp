#include "host/content/animator/motion/body/body.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include "hal/failure/failure.h"
#include "host/content/animator/motion/body/surface.h"
#include "host/content/elementary/elementary.h"

namespace mars::motion {
namespace {

constexpr double kStrikes = -15;  // degrees of pitch at which the heel is what touches
constexpr double kLeaves = 25;    // and the tip of a foot without toes
constexpr double kUpright = 0.8;  // of its height: what is lower sits

double lowest(std::span<const glm::dvec3> points, const glm::dmat3& turn, const glm::dvec3& from) {
  double least = 0;
  for (const glm::dvec3& point : points) least = std::min(least, (turn * point + from).z);
  return least;
}

glm::dvec3 lowest_point(const Sole& sole, double pitch) {
  const glm::dmat3 turn = canonical_turn(0, pitch, 0);
  glm::dvec3 least(0);
  for (const glm::dvec3& point : sole.foot)
    if ((turn * point).z < (turn * least).z) least = point;
  return {least.x, 0, least.z};
}

Sole sole_of(const modeler::Model& model, const Posture& drawn, const glm::dmat3& axes, std::size_t ankle,
             std::size_t toes) {
  const auto is_front = [&](std::size_t joint) { return modeler::is_at_or_below(model.joints, joint, toes); };
  const auto is_foot = [&](std::size_t joint) {
    return modeler::is_at_or_below(model.joints, joint, ankle) && !is_front(joint);
  };
  const std::vector<glm::dvec3> foot = points_of(model, drawn, is_foot), front = points_of(model, drawn, is_front);
  const glm::dmat3 back = glm::transpose(axes);
  const glm::dvec3 origin = frame_in(model, drawn, ankle).place;
  Sole sole;
  for (const glm::dvec3& point : foot) sole.foot.push_back(back * (point - origin));
  sole.bend = toes == modeler::kNone ? glm::dvec3(0) : back * (frame_in(model, drawn, toes).place - origin);
  for (const glm::dvec3& point : front) sole.toes.push_back(back * (point - origin) - sole.bend);
  sole.heel = lowest_point(sole, kStrikes);
  sole.ball = toes == modeler::kNone ? lowest_point(sole, kLeaves) : glm::dvec3(sole.bend.x, 0, sole.bend.z);
  return sole;
}

// The model's own axes where the limbs are within a few degrees of them: most figures stand along them.
glm::dmat3 nearly_square(const glm::dmat3& axes) {
  glm::dmat3 square;
  for (int column = 0; column < 3; ++column) square[column] = glm::round(axes[column]);
  for (int column = 0; column < 3; ++column)
    if (glm::distance(square[column], axes[column]) > 0.1) return axes;
  return square;
}

[[noreturn]] void fail_limb(const std::string& actor, const std::string& command, const std::string& limb) {
  throw Failure("its model names no " + limb + ", which '" + command + "' needs", "actor '" + actor + "'",
                "add it to the model's limbs: docs/model-format.md");
}

// The axes of a figure follow from where its hips and left ankle are, which must determine them.
void check_legs(const std::string& actor, const std::array<glm::dvec3, 2>& hips,
                const std::array<glm::dvec3, 2>& ankles) {
  const auto fail = [&](const std::string& problem) {
    throw Failure(problem, "actor '" + actor + "'",
                  "in its model, place the hips beside each other and the ankles below them");
  };
  constexpr double kLeast = 1e-3;  // of the leg
  for (const modeler::Side side : kSides) {
    const glm::dvec3 leg = ankles[index_of(side)] - hips[index_of(side)], across = hips[0] - hips[1];
    const double length = glm::length(leg);
    const std::string name = side == modeler::Side::left ? "left" : "right";
    if (!(length > 0) || !std::isfinite(length)) fail("its " + name + " leg has no length from hip to ankle");
    if (!(glm::length(across) > kLeast * length)) fail("its hips are at one place");
    if (!(glm::length(glm::cross(across, leg)) > kLeast * glm::length(across) * length))
      fail("its " + name + " leg points from one hip to the other");
  }
}

// The limbs of a leg, from the body outwards.
using LegLimbs = std::array<modeler::Limb, 4>;
constexpr LegLimbs kHindLeg{modeler::Limb::hip, modeler::Limb::knee, modeler::Limb::ankle, modeler::Limb::toes};
constexpr LegLimbs kForeleg{modeler::Limb::shoulder, modeler::Limb::elbow, modeler::Limb::wrist,
                            modeler::Limb::fingers};

Leg leg_of(const Body& body, const Posture& drawn, const LegLimbs& limbs, modeler::Side side) {
  const modeler::Model& model = *body.model;
  const auto find = [&](std::size_t part) { return model.limbs.of(limbs[part], side); };
  const auto place = [&](std::size_t joint) { return frame_in(model, drawn, joint).place; };
  Leg leg{find(0), find(1), find(2), find(3), 0, 0, 0, 0, {}};
  const glm::dvec3 hip = place(leg.hip), ankle = place(leg.ankle);
  const glm::dvec3 knee = leg.knee == modeler::kNone ? ankle : place(leg.knee);
  const glm::dmat3 back = glm::transpose(body.axes);
  leg.thigh = glm::distance(hip, knee);
  leg.shin = glm::distance(knee, ankle);
  if (leg.knee != modeler::kNone && !(leg.thigh > 0 && leg.shin > 0))
    throw Failure("its thigh or shin has no length", "actor '" + body.name + "'",
                  "in its model, place knees between hips and ankles");
  leg.aside = (back * (hip - place(body.pelvis))).y;
  const glm::dvec3 thigh = back * (knee - hip), shin = back * (ankle - knee);
  leg.bent = glm::degrees(elementary::atan2(thigh.z * shin.x - thigh.x * shin.z, thigh.x * shin.x + thigh.z * shin.z));
  leg.sole = sole_of(model, drawn, body.axes, leg.ankle, leg.toes);
  return leg;
}

// What comes down on its heel in a man comes down on its toes.
void stand_on_toes(Leg& leg) {
  if (leg.toes == modeler::kNone) return;
  leg.sole.on_toes = true;
  leg.sole.heel = leg.sole.ball;
}

// Of what a limb carries, as drawn.
double lowest_below(const modeler::Model& model, const Posture& drawn, modeler::Limb limb, modeler::Side side) {
  const auto is_below = [&](std::size_t joint) {
    return modeler::is_at_or_below(model.joints, joint, model.limbs.of(limb, side));
  };
  const std::vector<glm::dvec3> points = points_of(model, drawn, is_below);
  double least = 1e300;
  for (const glm::dvec3& point : points) least = std::min(least, point.z);
  return least;
}

// Square to the line from the hind feet to the forefeet: legs of four are not drawn straight.
glm::dvec3 down_between_feet(const modeler::Model& model, const Posture& drawn, const glm::dvec3& left) {
  const auto middle = [&](const LegLimbs& limbs) {
    glm::dvec3 sum(0);
    for (const modeler::Side side : kSides) {
      const std::size_t toes = model.limbs.of(limbs[3], side), ankle = model.limbs.of(limbs[2], side);
      sum += frame_in(model, drawn, toes == modeler::kNone ? ankle : toes).place;
    }
    return 0.5 * sum;
  };
  return glm::cross(left, middle(kForeleg) - middle(kHindLeg));
}

std::vector<std::size_t> limbs_of(const modeler::Model& model) {
  std::vector<std::size_t> all(model.limbs.trunk.begin(), model.limbs.trunk.end());
  for (const auto& side : model.limbs.sides) all.insert(all.end(), side.begin(), side.end());
  std::erase(all, modeler::kNone);
  return all;
}

}  // namespace

glm::dvec2 ahead_of(double heading) {
  return {elementary::cos(glm::radians(heading)), elementary::sin(glm::radians(heading))};
}

bool has_four_legs(const modeler::Model& model) {
  constexpr double kNear = 0.1;  // of the hip's height: how far front and hind feet are from one level
  for (const LegLimbs& limbs : {kHindLeg, kForeleg})
    for (const modeler::Side side : kSides)
      for (std::size_t part = 0; part < 3; ++part)
        if (model.limbs.of(limbs[part], side) == modeler::kNone) return false;
  const Posture drawn = drawn_posture(model);
  for (const modeler::Side side : kSides) {
    const double hind = lowest_below(model, drawn, modeler::Limb::ankle, side);
    const double high = frame_in(model, drawn, model.limbs.of(modeler::Limb::hip, side)).place.z - hind;
    if (std::abs(lowest_below(model, drawn, modeler::Limb::wrist, side) - hind) > kNear * high) return false;
  }
  return true;
}

double length_of_two_legs(const modeler::Model& model) {
  const auto find = [&](modeler::Limb limb) { return model.limbs.of(limb, modeler::Side::left); };
  const std::size_t hip = find(modeler::Limb::hip), ankle = find(modeler::Limb::ankle);
  if (hip == modeler::kNone || ankle == modeler::kNone || has_four_legs(model)) return 0;
  const std::size_t knee = find(modeler::Limb::knee) == modeler::kNone ? ankle : find(modeler::Limb::knee);
  const Posture drawn = drawn_posture(model);
  const auto place = [&](std::size_t joint) { return frame_in(model, drawn, joint).place; };
  return glm::distance(place(hip), place(knee)) + glm::distance(place(knee), place(ankle));
}

void require_two_legs(const modeler::Model& model, const std::string& actor, const std::string& command) {
  if (has_four_legs(model))
    throw Failure("has four legs, which '" + command + "' does not move", "actor '" + actor + "'",
                  "let it walk, trot, gallop or turn, or key its pose");
}

glm::dmat3 canonical_turn(double a, double b, double c) {
  return modeler::rotation_by_degrees({1, 0, 0}, a) * modeler::rotation_by_degrees({0, 1, 0}, b) *
         modeler::rotation_by_degrees({0, 0, 1}, c);
}

glm::dmat3 canonical_turn(const glm::dvec3& degrees) { return canonical_turn(degrees.x, degrees.y, degrees.z); }

glm::dvec3 canonical_degrees(const glm::dmat3& m) {
  return glm::degrees(glm::dvec3(elementary::atan2(-m[2][1], m[2][2]), elementary::asin(std::clamp(m[2][0], -1.0, 1.0)),
                                 elementary::atan2(-m[1][0], m[0][0])));
}

double Sole::height(double pitch, double bent) const {
  const glm::dmat3 turn = canonical_turn(0, pitch, 0);
  return -std::min(lowest(foot, turn, {0, 0, 0}), lowest(toes, turn * canonical_turn(0, bent, 0), turn * bend));
}

bool Body::planar() const {
  return std::any_of(legs.begin(), legs.end(), [&](const Leg& leg) { return model->joints[leg.hip].freedoms() < 2; });
}

std::vector<std::size_t> Body::joints() const {
  std::vector<std::size_t> all = limbs_of(*model);
  const std::vector<std::size_t> others = between();
  all.insert(all.end(), others.begin(), others.end());
  std::sort(all.begin(), all.end());
  return all;
}

std::vector<std::size_t> Body::between() const {
  std::vector<std::size_t> all;
  for (const std::size_t end : {find(modeler::Trunk::head), find(modeler::Limb::shoulder, modeler::Side::left),
                                find(modeler::Limb::shoulder, modeler::Side::right)}) {
    if (end == modeler::kNone || end == pelvis || !modeler::is_at_or_below(model->joints, end, pelvis)) continue;
    for (std::size_t joint = model->joints[end].parent; joint != pelvis; joint = model->joints[joint].parent)
      all.push_back(joint);
  }
  std::erase_if(all, [&](std::size_t joint) { return model->limbs.has(joint); });
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

double Body::heading_of(const Posture& posture) const {
  const glm::dvec3 forward = (actor_turn(posture) * axes)[0];
  return glm::degrees(elementary::atan2(forward.y, forward.x));
}

glm::dmat3 Body::turn_of(const Posture& posture, std::size_t joint) const {
  return frame_in(*model, posture, joint).turn * axes;
}

bool Body::is_upright(const Posture& posture) const {
  return frame_in(*model, posture, pelvis).place.z - floor_under(posture) >= kUpright * height;
}

double Body::floor_under(const Posture& posture) const {
  double least = 1e300;
  for (const Leg& leg : legs) {
    const modeler::Axes foot = frame_in(*model, posture, leg.ankle);
    least = std::min(least, foot.place.z + lowest(leg.sole.foot, foot.turn * axes, {0, 0, 0}));
    if (leg.toes == modeler::kNone) continue;
    const modeler::Axes toes = frame_in(*model, posture, leg.toes);
    for (const glm::dvec3& point : leg.sole.toes) least = std::min(least, (toes.turn * axes * point + toes.place).z);
  }
  return least;
}

double lowest_of(const modeler::Model& model, const Posture& posture) {
  const std::vector<glm::dvec3> points = points_of(model, posture, [](std::size_t) { return true; });
  double least = points.empty() ? posture.place.z : points[0].z;
  for (const glm::dvec3& point : points) least = std::min(least, point.z);
  return least;
}

Body body_of(const modeler::Model& model, const std::string& actor, const std::string& command) {
  Body body{&model, actor, glm::dmat3(1), model.limbs.of(modeler::Trunk::pelvis), {}};
  const Posture drawn = drawn_posture(model);
  std::array<glm::dvec3, 2> hips, ankles;
  for (const modeler::Side side : kSides) {
    hips[index_of(side)] = frame_in(model, drawn, needed(body, modeler::Limb::hip, side, command)).place;
    ankles[index_of(side)] = frame_in(model, drawn, needed(body, modeler::Limb::ankle, side, command)).place;
  }
  check_legs(actor, hips, ankles);
  if (body.pelvis == modeler::kNone)
    body.pelvis = model.joints[model.limbs.of(modeler::Limb::hip, modeler::Side::left)].parent;
  if (body.pelvis == modeler::kNone) fail_limb(actor, command, "pelvis");
  const glm::dvec3 pelvis = frame_in(model, drawn, body.pelvis).place;
  const glm::dvec3 left = glm::normalize(hips[0] - hips[1]);
  const glm::dvec3 legs = has_four_legs(model) ? down_between_feet(model, drawn, left) : ankles[0] - hips[0];
  const glm::dvec3 up = glm::normalize(glm::dot(legs, left) * left - legs);
  body.axes = nearly_square({glm::cross(left, up), left, up});
  const glm::dmat3 back = glm::transpose(body.axes);
  for (const modeler::Side side : kSides) body.legs[index_of(side)] = leg_of(body, drawn, kHindLeg, side);
  if (has_four_legs(model)) {
    body.forelegs.emplace();
    for (const modeler::Side side : kSides) (*body.forelegs)[index_of(side)] = leg_of(body, drawn, kForeleg, side);
    for (std::array<Leg, 2>* legs : {&body.legs, &*body.forelegs})
      for (Leg& leg : *legs) stand_on_toes(leg);
  }
  const double drawn_ankle = (back * (pelvis - frame_in(model, drawn, body.legs[0].ankle).place)).z;
  body.height = drawn_ankle + body.legs[0].sole.height(0, 0);
  return body;
}

Body body_without_legs(const modeler::Model& model, const std::string& actor) {
  for (const modeler::Side side : kSides)
    if (model.limbs.of(modeler::Limb::hip, side) == modeler::kNone ||
        model.limbs.of(modeler::Limb::ankle, side) == modeler::kNone ||
        model.joints[model.limbs.of(modeler::Limb::hip, side)].parent == modeler::kNone)
      return {&model, actor, glm::dmat3(1), model.limbs.of(modeler::Trunk::pelvis), {}};
  return body_of(model, actor, "");
}

std::size_t needed(const Body& body, modeler::Trunk part, const std::string& command) {
  const std::size_t joint = body.find(part);
  if (joint == modeler::kNone)
    fail_limb(body.name, command, std::string(modeler::kTrunkNames[static_cast<std::size_t>(part)]));
  return joint;
}

std::size_t needed(const Body& body, modeler::Limb limb, modeler::Side side, const std::string& command) {
  const std::size_t joint = body.find(limb, side);
  if (joint == modeler::kNone)
    fail_limb(body.name, command,
              std::string(side == modeler::Side::left ? "left " : "right ") +
                  std::string(modeler::kLimbNames[static_cast<std::size_t>(limb)]));
  return joint;
}

}  // namespace mars::motion
