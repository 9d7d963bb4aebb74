// A figure whose model names its limbs: what is forward, how long its legs are, what its soles are like.
// Commands are written once, for a body along x with y to its left and z up ("canonical"), and drive any
// figure.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/content/animator/motion/body/posture.h"

namespace mars::motion {

inline constexpr modeler::Side kSides[] = {modeler::Side::left, modeler::Side::right};
constexpr std::size_t index_of(modeler::Side side) { return static_cast<std::size_t>(side); }
constexpr modeler::Side other(modeler::Side side) {
  return side == modeler::Side::left ? modeler::Side::right : modeler::Side::left;
}
constexpr double sign_of(modeler::Side side) { return side == modeler::Side::left ? 1 : -1; }

// On the floor: the direction of a heading, in degrees from x to y, and what is left of a direction.
glm::dvec2 ahead_of(double heading);
constexpr glm::dvec2 left_of(const glm::dvec2& ahead) { return {-ahead.y, ahead.x}; }

// Rot(x, a) Rot(y, b) Rot(z, c), degrees: about forward, left and up. Positive y nods, positive z turns left.
glm::dmat3 canonical_turn(double a, double b, double c);
glm::dmat3 canonical_turn(const glm::dvec3& degrees);
// The other way round: degrees.
glm::dvec3 canonical_degrees(const glm::dmat3& matrix);

// The foot's underside, canonical, from the ankle; toes from the joint that bends them.
struct Sole {
  std::vector<glm::dvec3> foot, toes;
  glm::dvec3 bend;        // of the toes, from the ankle
  glm::dvec3 heel, ball;  // on what the foot comes down, and on what it leaves
  bool on_toes = false;   // of four legs: the toes alone stand

  // How high the ankle is over the floor when the foot, pitched with its toes down by `pitch` degrees and the
  // toes bent against it, touches it.
  double height(double pitch, double bent) const;
};

struct Leg {
  std::size_t hip, knee, ankle, toes;  // knee and toes may be kNone
  double thigh, shin;                  // lengths; a leg of one piece is all thigh
  double aside;                        // of the hip from the pelvis' middle
  double bent;                         // of the knee as drawn, degrees, the shin backward
  Sole sole;

  double length() const { return thigh + shin; }
};

struct Body {
  const modeler::Model* model;
  std::string name;    // of the actor, for messages
  glm::dmat3 axes;     // forward, left, up in the model's own frame
  std::size_t pelvis;  // named, or the joint that carries the hips
  std::array<Leg, 2> legs;
  std::optional<std::array<Leg, 2>> forelegs{};  // where shoulders carry legs, too
  double height = 0;                             // of the pelvis over the floor as drawn, where it stands

  const Leg& leg(modeler::Side side) const { return legs[index_of(side)]; }
  double leg_length() const { return legs[0].length(); }
  bool planar() const;  // legs swing forward and back alone
  bool stiff() const { return legs[0].knee == modeler::kNone; }

  std::size_t find(modeler::Trunk part) const { return model->limbs.of(part); }
  std::size_t find(modeler::Limb limb, modeler::Side side) const { return model->limbs.of(limb, side); }
  // All joints that are limbs or lie between limbs, in the model's order.
  std::vector<std::size_t> joints() const;
  // What lies between pelvis and head, or pelvis and shoulder, and is no limb: further joints of a back, collarbones.
  std::vector<std::size_t> between() const;
  const std::string& joint_name(std::size_t joint) const { return model->joints[joint].name; }

  double heading_of(const Posture& posture) const;  // degrees from x to y
  // A joint's orientation in the world, canonical.
  glm::dmat3 turn_of(const Posture& posture, std::size_t joint) const;
  // Of the posture's lower sole.
  double floor_under(const Posture& posture) const;
  bool is_upright(const Posture& posture) const;  // or it sits
};

// The least z of all segments in the world.
double lowest_of(const modeler::Model& model, const Posture& posture);

// Throws Failure where limbs that every command needs are not named.
Body body_of(const modeler::Model& model, const std::string& actor, const std::string& command);

// Whether wrists are named and what they carry reaches the floor as the hind feet do, as drawn.
bool has_four_legs(const modeler::Model& model);

// From hip to ankle over the knee; 0 where the model names no such limbs, or has four legs.
double length_of_two_legs(const modeler::Model& model);

// Throws Failure for figures with four legs.
void require_two_legs(const modeler::Model& model, const std::string& actor, const std::string& command);

// What a command needs that moves no legs: axes as those of the legs, or where these are not named forward
// along x and up along z. `legs` is not to be asked.
Body body_without_legs(const modeler::Model& model, const std::string& actor);

// The joint, or a Failure that names the limb as in "limbs.left.shoulder".
std::size_t needed(const Body& body, modeler::Trunk part, const std::string& command);
std::size_t needed(const Body& body, modeler::Limb limb, modeler::Side side, const std::string& command);

}  // namespace mars::motion
