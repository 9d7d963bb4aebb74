// Limbs while they are searched for: which joint may be which limb, before the tree has the last word.
#pragma once

#include <string>
#include <vector>

#include "host/content/importer/limbs/figure_tree.h"

namespace mars::importer {

inline constexpr modeler::Side kBothSides[] = {modeler::Side::left, modeler::Side::right};

struct LimbDraft {
  modeler::Limbs limbs;             // of the tree's joints
  std::string by;                   // what found them: "the names of Rigify"
  bool is_guess = false;            // by the shape
  std::vector<std::string> doubts;  // each a sentence's part, for people

  std::size_t& of(modeler::Trunk part) { return limbs.trunk[static_cast<std::size_t>(part)]; }
  std::size_t& of(modeler::Limb limb, modeler::Side side) {
    return limbs.sides[static_cast<std::size_t>(side)][static_cast<std::size_t>(limb)];
  }
  std::size_t count() const;  // of limbs
  bool has_both(modeler::Limb limb) const;
};

// Takes out what a model could not have: a joint that is two limbs, or does not hang below the limb before it. Then the
// trunk by the tree: the pelvis, where nothing names it, is what carries both hips; the chest carries both shoulders,
// the spine is the first joint on the way there from the pelvis, and neck and head are what is left of the trunk above
// it.
void complete(const FigureTree& tree, LimbDraft& draft);

}  // namespace mars::importer
