// The joints of a file's figure, as the search for its limbs sees them.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "host/content/modeler/joint.h"
#include "host/content/modeler/limbs.h"

namespace mars::importer {

struct TreeJoint {
  std::string name;     // the file's; "": it has none
  std::size_t parent;   // an index before this one's; kNone: it hangs from none
  glm::dvec3 place;     // at rest, in the model's axes: z up
  bool is_bone = true;  // a surface follows it
};

using FigureTree = std::vector<TreeJoint>;

bool is_at_or_below(const FigureTree& tree, std::size_t joint, std::size_t above);
// The lowest joint above all of `joints`, or one of them; kNone: there is none.
std::size_t common_joint(const FigureTree& tree, std::span<const std::size_t> joints);
// From `above`, without it, down to `joint`; empty where it is not below.
std::vector<std::size_t> way_down(const FigureTree& tree, std::size_t above, std::size_t joint);

// "left.knee"
std::string limb_name(modeler::Trunk part);
std::string limb_name(modeler::Limb limb, modeler::Side side);

// All that are known, in the order of a model file.
std::vector<std::pair<std::string, std::size_t>> named(const modeler::Limbs& limbs);

}  // namespace mars::importer
