// Limbs of any creature or puppet, lofted (loft.h), closed, filling the unit cube, hanging down: one round
// length each, and a mitten that fits a left and a right arm. Ends at joints are half balls about them, so
// that limbs of one scale turn in each other. docs/model-format.md has the boxes for lengths of 1.
#pragma once

#include <vector>

#include "node/wire/film_parts.h"

namespace mars::modeler {

std::vector<wire::Patch> make_upper_limb();  // an upper arm or a thigh
std::vector<wire::Patch> make_lower_limb();  // a forearm or a shin, its muscle behind
std::vector<wire::Patch> make_hand();        // a mitten, thumb forward, the same from left and right

}  // namespace mars::modeler
