// A hand that pulls a limb: the posture within limits that brings a place of a figure to where it shall be, with what
// turns for it and what stays where it is. Damped least squares over all numbers at once (reach.h), fast enough to be
// asked at each move of a mouse.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "host/content/animator/motion/body/posture.h"

namespace mars::motion {

// How much of a figure goes along.
enum class Extent {
  limb,   // arm, leg, or head with neck and spine
  trunk,  // spine and chest, too, where the limb alone is too short
  body    // and the actor's place and the pelvis' turn: with pinned feet it bends its knees
};

struct Chain {
  std::size_t end;                  // the joint in whose frame the pulled place is
  std::vector<std::size_t> joints;  // that turn, from the top down
  std::vector<std::size_t> trunk;   // that turn, too, but rather not
  bool moves_actor = false;         // the actor's place changes, too
};

// By the limb table: of what is at or below an ankle, hip to ankle and the joint itself; at or below a wrist, shoulder
// to wrist; of a head, spine to head; of a pelvis, the actor's place alone. Of other joints: from the joint up to
// below the nearest that carries several, or the root.
Chain chain_of(const modeler::Model& model, std::size_t joint, Extent extent = Extent::limb);

struct Pull {
  glm::dvec3 held{0, 0, 0};          // in the frame of the chain's end
  glm::dvec3 to{0, 0, 0};            // where it shall be, in the world
  std::optional<glm::dmat3> turn{};  // of the end's frame in the world; the place comes first
};

// Changes `posture` so that the pull is met as nearly as limits allow, and returns the distance that is left.
//
// `rest` is the figure before anybody pulled, within its limits. Of all postures that meet the pull the one nearest to
// it is found, so that what is pulled there and back is as it was. `posture` is what was shown last: the search begins
// there; the first time it is `rest`. Same arguments, same result, bit for bit.
//
// `pins` keep the frames that they have in `rest`: what carries a pinned joint turns by itself, as the chain of the
// pin has it. A pin comes before the pull: where both cannot be, the pull is not met. A pin above all that moves costs
// nothing.
double pull(const modeler::Model& model, const Posture& rest, Posture& posture, const Chain& chain, const Pull& pull,
            std::span<const std::size_t> pins = {});

}  // namespace mars::motion
