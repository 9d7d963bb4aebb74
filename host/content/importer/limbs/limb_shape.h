// Limbs by the shape of a figure, where its joints' names say nothing: two like chains of joints that reach the ground
// are legs, two like chains above them arms, what stands highest between the arms is the head.
#pragma once

#include <optional>

#include "host/content/importer/limbs/limb_draft.h"

namespace mars::importer {

// None where there are no such legs. Which side is left follows from where the feet point, else from the way the knees
// are bent; where both say nothing, the figure is taken to look along -y, as glTF's do that look along z, and that is
// one of the draft's doubts. Not completed.
std::optional<LimbDraft> limbs_by_shape(const FigureTree& tree);

}  // namespace mars::importer
