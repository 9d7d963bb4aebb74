#include "host/content/importer/limbs/limb_draft.h"

#include <algorithm>

#include "host/content/document/text.h"

namespace mars::importer {
namespace {

using modeler::kNone;
using modeler::Limb;
using modeler::Side;
using modeler::Trunk;

constexpr Limb kLeg[] = {Limb::hip, Limb::knee, Limb::ankle, Limb::toes};
constexpr Limb kArm[] = {Limb::shoulder, Limb::elbow, Limb::wrist, Limb::fingers};

// Each limb of an arm or a leg below the one before it.
void check_chain(const FigureTree& tree, LimbDraft& draft, std::span<const Limb> chain, Side side) {
  std::size_t before = kNone;
  Limb limb_before = chain[0];
  for (const Limb limb : chain) {
    std::size_t& joint = draft.of(limb, side);
    if (joint == kNone) continue;
    if (before != kNone && (joint == before || !is_at_or_below(tree, joint, before))) {
      draft.doubts.push_back("'" + document::printable(tree[joint].name) + "' does not hang below '" +
                             document::printable(tree[before].name) + "', the " + limb_name(limb_before, side) +
                             ": no " + limb_name(limb, side));
      joint = kNone;
      continue;
    }
    before = joint;
    limb_before = limb;
  }
}

// Both joints, or none.
std::vector<std::size_t> both(const LimbDraft& draft, Limb limb) {
  std::vector<std::size_t> joints{draft.limbs.of(limb, Side::left), draft.limbs.of(limb, Side::right)};
  if (std::ranges::count(joints, kNone) > 0) joints.clear();
  return joints;
}

void complete_pelvis(const FigureTree& tree, LimbDraft& draft) {
  const std::vector<std::size_t> hips = both(draft, Limb::hip);
  if (hips.empty()) return;
  std::size_t& pelvis = draft.of(Trunk::pelvis);
  const auto carries = [&](std::size_t hip) { return is_at_or_below(tree, hip, pelvis); };
  if (pelvis == kNone || !std::ranges::all_of(hips, carries)) pelvis = common_joint(tree, hips);
}

// The first joint below `above` on the way to `joint` that carries no leg.
std::size_t first_of_spine(const FigureTree& tree, const LimbDraft& draft, std::size_t above, std::size_t joint) {
  const std::size_t hip = draft.limbs.of(Limb::hip, Side::left);
  for (const std::size_t each : way_down(tree, above, joint))
    if (hip == kNone || !is_at_or_below(tree, hip, each)) return each;
  return kNone;
}

void complete_chest(const FigureTree& tree, LimbDraft& draft) {
  const std::vector<std::size_t> shoulders = both(draft, Limb::shoulder);
  const std::size_t pelvis = draft.of(Trunk::pelvis);
  if (shoulders.empty() || pelvis == kNone) return;
  std::size_t chest = common_joint(tree, shoulders);
  if (chest != kNone && chest == draft.of(Trunk::neck)) chest = tree[chest].parent;  // Biped's arms hang from its neck
  if (chest == kNone || chest == pelvis || !is_at_or_below(tree, chest, pelvis)) return;
  const std::size_t spine = first_of_spine(tree, draft, pelvis, chest);
  if (spine == kNone) return;
  draft.of(Trunk::spine) = spine;
  draft.of(Trunk::chest) = chest == spine ? kNone : chest;
}

std::size_t last_of_trunk(const LimbDraft& draft) {
  for (const Trunk part : {Trunk::chest, Trunk::spine, Trunk::pelvis})
    if (const std::size_t joint = draft.limbs.of(part); joint != kNone) return joint;
  return kNone;
}

bool carries_arms(const FigureTree& tree, const LimbDraft& draft, std::size_t joint) {
  const std::size_t shoulder = draft.limbs.of(Limb::shoulder, Side::left);
  return shoulder != kNone && is_at_or_below(tree, shoulder, joint);
}

// Where only the head is known, the neck is the first joint on the way to it; a joint that carries arms is no neck.
void complete_neck(const FigureTree& tree, LimbDraft& draft) {
  const std::size_t below = last_of_trunk(draft);
  std::size_t &neck = draft.of(Trunk::neck), &head = draft.of(Trunk::head);
  if (below == kNone) return;
  for (std::size_t* part : {&neck, &head})
    if (*part != kNone && (*part == below || !is_at_or_below(tree, *part, below) || carries_arms(tree, draft, *part)))
      *part = kNone;
  if (head == kNone) return;
  if (neck == kNone || neck == head || !is_at_or_below(tree, head, neck)) {
    const std::size_t first = way_down(tree, below, head).front();
    neck = first == head || carries_arms(tree, draft, first) ? kNone : first;
  }
}

}  // namespace

std::size_t LimbDraft::count() const {
  std::size_t count = limbs.trunk.size() - static_cast<std::size_t>(std::ranges::count(limbs.trunk, kNone));
  for (const auto& side : limbs.sides) count += side.size() - static_cast<std::size_t>(std::ranges::count(side, kNone));
  return count;
}

bool LimbDraft::has_both(Limb limb) const { return !both(*this, limb).empty(); }

void complete(const FigureTree& tree, LimbDraft& draft) {
  for (const Side side : kBothSides) {
    check_chain(tree, draft, kLeg, side);
    check_chain(tree, draft, kArm, side);
  }
  complete_pelvis(tree, draft);
  complete_chest(tree, draft);
  complete_neck(tree, draft);
}

}  // namespace mars::importer
