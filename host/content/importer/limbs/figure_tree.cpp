#include "host/content/importer/limbs/figure_tree.h"

#include <algorithm>

namespace mars::importer {

bool is_at_or_below(const FigureTree& tree, std::size_t joint, std::size_t above) {
  while (joint != modeler::kNone && joint != above) joint = tree[joint].parent;
  return joint != modeler::kNone;
}

std::size_t common_joint(const FigureTree& tree, std::span<const std::size_t> joints) {
  std::size_t common = joints[0];
  const auto holds = [&](std::size_t joint) { return is_at_or_below(tree, joint, common); };
  while (common != modeler::kNone && !std::ranges::all_of(joints, holds)) common = tree[common].parent;
  return common;
}

std::vector<std::size_t> way_down(const FigureTree& tree, std::size_t above, std::size_t joint) {
  std::vector<std::size_t> way;
  for (; joint != modeler::kNone && joint != above; joint = tree[joint].parent) way.push_back(joint);
  if (joint == modeler::kNone) return {};
  std::ranges::reverse(way);
  return way;
}

std::string limb_name(modeler::Trunk part) { return std::string(modeler::kTrunkNames[static_cast<std::size_t>(part)]); }

std::string limb_name(modeler::Limb limb, modeler::Side side) {
  return (side == modeler::Side::left ? "left." : "right.") +
         std::string(modeler::kLimbNames[static_cast<std::size_t>(limb)]);
}

std::vector<std::pair<std::string, std::size_t>> named(const modeler::Limbs& limbs) {
  std::vector<std::pair<std::string, std::size_t>> all;
  for (std::size_t part = 0; part < limbs.trunk.size(); ++part)
    all.emplace_back(limb_name(modeler::Trunk(part)), limbs.trunk[part]);
  for (const modeler::Side side : {modeler::Side::left, modeler::Side::right})
    for (std::size_t limb = 0; limb < std::size(modeler::kLimbNames); ++limb)
      all.emplace_back(limb_name(modeler::Limb(limb), side), limbs.of(modeler::Limb(limb), side));
  std::erase_if(all, [](const auto& each) { return each.second == modeler::kNone; });
  return all;
}

}  // namespace mars::importer
