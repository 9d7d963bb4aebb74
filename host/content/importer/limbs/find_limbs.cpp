#include "host/content/importer/limbs/find_limbs.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "host/content/document/text.h"
#include "host/content/importer/limbs/limb_draft.h"
#include "host/content/importer/limbs/limb_names.h"
#include "host/content/importer/limbs/limb_shape.h"

namespace mars::importer {
namespace {

using modeler::kNone;
using modeler::Limb;
using modeler::Side;
using modeler::Trunk;

constexpr std::size_t kMostJointsWithNames = 20'000;  // of files whose names are looked through

std::size_t* joint_of(LimbDraft& draft, const std::string& limb) {
  for (std::size_t part = 0; part < std::size(modeler::kTrunkNames); ++part)
    if (limb_name(Trunk(part)) == limb) return &draft.of(Trunk(part));
  for (const Side side : kBothSides)
    for (std::size_t each = 0; each < std::size(modeler::kLimbNames); ++each)
      if (limb_name(Limb(each), side) == limb) return &draft.of(Limb(each), side);
  return nullptr;
}

std::optional<LimbDraft> limbs_by_map(const LimbMap& map) {
  LimbDraft draft;
  draft.by = map.by;
  std::set<std::size_t> used;
  for (const auto& [limb, joint] : map.limbs) {
    std::size_t* const place = joint_of(draft, limb);
    if (place != nullptr && used.insert(joint).second) *place = joint;
  }
  if (draft.count() == 0) return std::nullopt;
  return draft;
}

// What people miss: toes and fingers are often not there.
std::vector<std::string> missing_limbs(const LimbDraft& draft) {
  std::vector<std::string> missing;
  for (const Trunk part : {Trunk::pelvis, Trunk::head})
    if (draft.limbs.of(part) == kNone) missing.push_back(limb_name(part));
  for (const Limb limb : {Limb::hip, Limb::knee, Limb::ankle, Limb::shoulder, Limb::elbow, Limb::wrist})
    for (const Side side : kBothSides)
      if (draft.limbs.of(limb, side) == kNone) missing.push_back(limb_name(limb, side));
  return missing;
}

std::string made_text(const LimbDraft& draft) {
  const std::string limbs = document::counted(draft.count(), "limb", "limbs");
  return draft.is_guess ? limbs + ", guessed by the figure's shape" : limbs + " by the " + draft.by;
}

std::optional<LimbDraft> draft_of(const FigureTree& tree, const std::optional<LimbMap>& map, bool may_guess) {
  std::optional<LimbDraft> draft;
  if (map) draft = limbs_by_map(*map);
  if (!draft && tree.size() <= kMostJointsWithNames) draft = limbs_by_names(tree);
  if (!draft && may_guess) draft = limbs_by_shape(tree);
  return draft;
}

}  // namespace

FiguresLimbs find_limbs(const FigureTree& tree, const std::optional<LimbMap>& map, bool may_guess) {
  FiguresLimbs found{{}, std::vector<std::optional<JointAnatomy>>(tree.size()), false, "", "", {}};
  std::optional<LimbDraft> draft = draft_of(tree, map, may_guess);
  if (!draft) return found;
  complete(tree, *draft);
  found.limbs = draft->limbs;
  found.anatomy = anatomy_of(tree, draft->limbs);
  found.doubts = draft->doubts;
  if (const std::vector<std::string> missing = missing_limbs(*draft); !missing.empty())
    found.doubts.push_back("not found: " + document::joined(missing));
  found.is_guess = draft->is_guess;
  found.limbs_made = made_text(*draft);
  const auto limited = std::ranges::count_if(found.anatomy, [](const auto& each) { return each && each->limits; });
  if (limited > 0) found.limits_made = ", people's limits for " + document::counted(std::size_t(limited), "joint");
  return found;
}

std::optional<glm::dvec3> front_of(const FigureTree& tree, const modeler::Limbs& limbs) {
  for (const Limb limb : {Limb::hip, Limb::shoulder}) {
    const std::size_t left = limbs.of(limb, Side::left), right = limbs.of(limb, Side::right);
    if (left == kNone || right == kNone) continue;
    const glm::dvec3 to_left = tree[left].place - tree[right].place;
    if (to_left.x == 0 && to_left.y == 0) continue;
    const bool along_x = std::abs(to_left.y) >= std::abs(to_left.x);
    return along_x ? glm::dvec3(std::copysign(1, to_left.y), 0, 0) : glm::dvec3(0, std::copysign(1, -to_left.x), 0);
  }
  return std::nullopt;
}

}  // namespace mars::importer
