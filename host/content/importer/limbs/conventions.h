// How programs and libraries name the joints of people: the one table of it.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "host/content/modeler/limbs.h"

namespace mars::importer {

// Names in small letters and digits only, as plain_letters() leaves them: "mixamorig:LeftUpLeg" is
// "mixamorigleftupleg". '%' stands for the side's word, '|' is between alternatives, of which the first that is there
// counts; "": the convention has no such joint. Anything may precede a name, the same for all joints of a figure. Spine
// and chest follow from the tree: the chest carries the arms, whatever the number of vertebrae.
struct Convention {
  const char* name;  // for people
  const char* source;
  std::string_view left, right;
  std::string_view pelvis, neck, head;
  std::array<std::string_view, std::size(modeler::kLimbNames)> limbs;  // hip, knee, ankle, toes, shoulder, ...
};

std::span<const Convention> conventions();

}  // namespace mars::importer
