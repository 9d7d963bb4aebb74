// Limbs by the names of joints: the convention of conventions.h to which most of them fit.
#pragma once

#include <optional>

#include "host/content/importer/limbs/limb_draft.h"

namespace mars::importer {

// "mixamorig:LeftUpLeg" as "mixamorigleftupleg".
std::string plain_letters(std::string_view name);

// None where no convention names both hips and both knees, or both shoulders and both elbows. Of joints with one name
// the first bone counts. Not completed.
std::optional<LimbDraft> limbs_by_names(const FigureTree& tree);

}  // namespace mars::importer
