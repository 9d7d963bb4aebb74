// What a body does at a moment, in the world, and the turns of joints that bring it about.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <map>
#include <string>

#include "host/content/animator/motion/body/body.h"

namespace mars::motion {

struct Foot {
  glm::dvec3 ankle;    // in the world
  double heading = 0;  // degrees, from x to y
  double pitch = 0;    // of the sole, degrees, toes down
  double bent = 0;     // of the toes, degrees, down
  bool stands = true;  // on the floor: it must be there, flat feet flat
  double askew = 0;    // degrees that it may point beside its heading, flat, where its ankle cannot twist
};

struct Stance {
  double heading = 0;        // of the figure, degrees
  glm::dvec3 pelvis;         // place of the joint
  glm::dvec3 tilt{0, 0, 0};  // of the pelvis: canonical degrees beyond the heading
  std::array<Foot, 2> feet;
  std::array<Foot, 2> forefeet{};           // of four legs
  std::map<std::size_t, glm::dmat3> turns;  // of other joints against their parents, canonical
};

// The stance that a posture shows; `turns` is left empty.
Stance stance_of(const Body& body, const Posture& posture);

// A turn of an upper arm, forearm or hand against its parent for an arm that hangs straight down, whichever way the
// model's arms are drawn: hanging, held out to the sides, with bent elbows.
glm::dmat3 hanging_shoulder(const Body& body, modeler::Side side, const glm::dvec3& degrees);
glm::dmat3 hanging_elbow(const Body& body, modeler::Side side, const glm::dvec3& degrees);
glm::dmat3 hanging_wrist(const Body& body, modeler::Side side, const glm::dvec3& degrees);

// Lets what lies between the limbs be as it is drawn.
void straighten_between(const Body& body, Stance& stance);

// Turns and places the posture's pelvis as the stance has it, as nearly as limits allow.
void place_pelvis(const Body& body, const Stance& stance, Posture& posture);

// The joint's numbers within its limits, nearest to a canonical turn against its parent; `near` begins.
glm::dvec3 numbers_for(const Body& body, std::size_t joint, const glm::dmat3& turn, const glm::dvec3& near);

// Changes `posture`, that of the moment before, to the stance, by inverse kinematics of the legs. Where a
// standing foot cannot be as wanted it is a Failure that names the joint in the way; `doing` says what is
// being done, "walk at frame 12", `remedy` what to change.
void take_stance(const Body& body, const Stance& stance, Posture& posture, const std::string& doing,
                 const std::string& remedy);

}  // namespace mars::motion
