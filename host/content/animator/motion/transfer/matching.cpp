#include "host/content/animator/motion/transfer/matching.h"

#include <algorithm>
#include <cctype>

namespace mars::motion {
namespace {

using modeler::kNone;

std::string plain_name(const std::string& name) {
  std::string plain = name.substr(name.rfind(':') == std::string::npos ? 0 : name.rfind(':') + 1);
  for (char& letter : plain) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return plain;
}

void add_limb(std::size_t from, std::size_t to, Matching& matching) {
  if (from == kNone || to == kNone) return;
  matching.joints.push_back({from, to});
  ++matching.by_limb;
}

void add_by_names(const modeler::Model& from, const modeler::Model& to, Matching& matching) {
  for (std::size_t joint = 0; joint < to.joints.size(); ++joint) {
    if (matching.from_of(joint) != kNone) continue;
    const std::string name = plain_name(to.joints[joint].name);
    for (std::size_t other = 0; other < from.joints.size(); ++other) {
      if (matching.takes(other) || plain_name(from.joints[other].name) != name) continue;
      matching.joints.push_back({other, joint});
      ++matching.by_name;
      break;
    }
  }
}

}  // namespace

std::size_t Matching::from_of(std::size_t to) const {
  const auto found = std::find_if(joints.begin(), joints.end(), [&](const Match& match) { return match.to == to; });
  return found == joints.end() ? kNone : found->from;
}

bool Matching::takes(std::size_t from) const {
  return std::any_of(joints.begin(), joints.end(), [&](const Match& match) { return match.from == from; });
}

Matching match_joints(const modeler::Model& from, const modeler::Model& to) {
  Matching matching;
  for (std::size_t part = 0; part < from.limbs.trunk.size(); ++part)
    add_limb(from.limbs.trunk[part], to.limbs.trunk[part], matching);
  for (std::size_t side = 0; side < 2; ++side)
    for (std::size_t limb = 0; limb < from.limbs.sides[side].size(); ++limb)
      add_limb(from.limbs.sides[side][limb], to.limbs.sides[side][limb], matching);
  add_by_names(from, to, matching);
  std::sort(matching.joints.begin(), matching.joints.end(), [](const Match& a, const Match& b) { return a.to < b.to; });
  return matching;
}

}  // namespace mars::motion
