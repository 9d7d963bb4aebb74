// The human's shapes, lofted (loft.h), closed like the primitives, filling the unit cube: x forward, y left,
// z up, limbs hanging down. Ends at joints are round, so that neighbours overlap there however they bend.
// docs/model-format.md has the boxes that give them the size of a man; other boxes make other people.
#pragma once

#include <vector>

#include "node/wire/film_parts.h"

namespace mars::modeler {

// clang-format off
enum class BodyPart {
  head, hair, neck, torso, abdomen, pelvis,
  upper_arm, sleeve, forearm, left_hand, right_hand,
  thigh, shin, foot, toes
};
// clang-format on

std::vector<wire::Patch> make_body(BodyPart part);

}  // namespace mars::modeler
