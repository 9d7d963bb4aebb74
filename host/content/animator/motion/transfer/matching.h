// Which joint of one figure stands for which of another: limbs by what they are, others by their names.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "host/content/modeler/model.h"

namespace mars::motion {

struct Match {
  std::size_t from, to;  // joints of the two models
};

struct Matching {
  std::vector<Match> joints;  // by the joint of the second model, ascending
  std::size_t by_limb = 0, by_name = 0;

  // Of a joint of the second model: that of the first; kNone if there is none.
  std::size_t from_of(std::size_t to) const;
  bool takes(std::size_t from) const;  // whether a joint of the first stands for one of the second
};

// Limbs that both models name; then joints of one name, whose prefix ("mixamorig:") and capitals do not count.
Matching match_joints(const modeler::Model& from, const modeler::Model& to);

}  // namespace mars::motion
