#include "host/content/modeler/limbs.h"

#include <algorithm>
#include <string>
#include <unordered_set>
#include <vector>

namespace mars::modeler {
namespace {

class LimbReader {
 public:
  explicit LimbReader(std::span<const Joint> joints) : joints_(joints) {}

  Limbs read(const document::Element& element) {
    const document::Fields fields(element, keys::object("limbs"));
    Limbs limbs;
    for (std::size_t part = 0; part < limbs.trunk.size(); ++part)
      limbs.trunk[part] = read_joint(fields, kTrunkNames[part]);
    read_side(fields, "left", limbs.sides[0]);
    read_side(fields, "right", limbs.sides[1]);
    require_order(fields, limbs.trunk, kTrunkNames);
    return limbs;
  }

 private:
  template <typename Joints>
  void read_side(const document::Fields& fields, std::string_view side, Joints& found) {
    const auto element = fields.find(side);
    if (!element) return;
    const document::Fields limbs(*element, keys::object("side"));
    for (std::size_t limb = 0; limb < found.size(); ++limb) found[limb] = read_joint(limbs, kLimbNames[limb]);
    constexpr std::size_t legs = static_cast<std::size_t>(Limb::shoulder);
    require_order(limbs, std::span(found).first(legs), std::span(kLimbNames).first(legs));
    require_order(limbs, std::span(found).subspan(legs), std::span(kLimbNames).subspan(legs));
  }

  std::size_t read_joint(const document::Fields& fields, std::string_view key) {
    const auto element = fields.find(key);
    if (!element) return kNone;
    const std::string name = document::read_text(*element);
    const auto found = std::find_if(joints_.begin(), joints_.end(), [&](const Joint& j) { return j.name == name; });
    if (found == joints_.end()) {
      std::vector<std::string_view> names;
      for (const Joint& joint : joints_) names.push_back(joint.name);
      element->refuse("is '" + name + "', which is no joint of this model",
                      document::did_you_mean(name, names, "name a joint of this model, or leave the limb out"));
    }
    const auto joint = static_cast<std::size_t>(found - joints_.begin());
    if (!used_.insert(joint).second)
      element->refuse("is '" + name + "', which is another limb already", "name each joint once");
    return joint;
  }

  void require_order(const document::Fields& fields, std::span<const std::size_t> chain,
                     std::span<const std::string_view> names) const {
    std::size_t before = kNone, before_name = 0;
    for (std::size_t i = 0; i < chain.size(); ++i) {
      if (chain[i] == kNone) continue;
      if (before != kNone && !is_at_or_below(joints_, chain[i], before))
        fields.find(names[i])->refuse(
            "is '" + joints_[chain[i]].name + "', which does not hang below the " + std::string(names[before_name]) +
                " '" + joints_[before].name + "'",
            "name joints from the body outwards; mars model MODEL set JOINT --reset limb makes a joint no limb");
      before = chain[i];
      before_name = i;
    }
  }

  std::span<const Joint> joints_;
  std::unordered_set<std::size_t> used_;
};

}  // namespace

Limbs::Limbs() {
  trunk.fill(kNone);
  for (auto& side : sides) side.fill(kNone);
}

bool Limbs::has(std::size_t joint) const {
  const auto is_in = [&](const auto& list) { return std::find(list.begin(), list.end(), joint) != list.end(); };
  return is_in(trunk) || is_in(sides[0]) || is_in(sides[1]);
}

Limbs read_limbs(const document::Element& element, std::span<const Joint> joints) {
  return LimbReader(joints).read(element);
}

}  // namespace mars::modeler
