// Which joints of a file's figure are its limbs: by the file's own map, by names, or by the figure's shape.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/content/importer/limbs/anatomy.h"
#include "host/content/importer/limbs/figure_tree.h"

namespace mars::importer {

// A file's own: each a limb, as limb_name() names it, and a joint of the tree; chest and spine need not be there.
struct LimbMap {
  std::string by;  // "the file's map of VRM"
  std::vector<std::pair<std::string, std::size_t>> limbs;
};

struct FiguresLimbs {
  modeler::Limbs limbs;                              // of the tree's joints
  std::vector<std::optional<JointAnatomy>> anatomy;  // by joint of the tree
  bool is_guess = false;                             // by the shape
  std::string limbs_made;                            // for the report: how many, and what found them; "": no limbs
  std::string limits_made;                           // for the report, after it; "": no limits
  std::vector<std::string> doubts;                   // for the report

  std::string made() const { return limbs_made + limits_made; }
};

// What a map gives counts before names, names (of at most 20,000 joints) before the shape. `may_guess`: whether the
// shape counts at all.
FiguresLimbs find_limbs(const FigureTree& tree, const std::optional<LimbMap>& map, bool may_guess);

// Of x, y, -x and -y the one nearest to where the figure looks at rest; none where no two limbs of one kind say it.
std::optional<glm::dvec3> front_of(const FigureTree& tree, const modeler::Limbs& limbs);

}  // namespace mars::importer
