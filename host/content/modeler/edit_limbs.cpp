#include "host/content/modeler/edit_limbs.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <vector>

#include "hal/failure/failure.h"
#include "host/content/document/fields.h"
#include "host/content/modeler/limbs.h"

namespace mars::modeler {
namespace {

constexpr std::string_view kSideNames[] = {"left", "right"};

// Calls visit(limbs, key, "left.knee") for each limb that is named.
template <typename Limbs, typename Visit>
void for_each_limb(Limbs& model, Visit visit) {
  if (!model.contains("limbs")) return;
  auto& limbs = model["limbs"];
  for (const std::string_view part : kTrunkNames)
    if (limbs.contains(part)) visit(limbs, std::string(part), std::string(part));
  for (const std::string_view side : kSideNames) {
    if (!limbs.contains(side)) continue;
    auto& of_side = limbs[std::string(side)];
    for (const std::string_view limb : kLimbNames)
      if (of_side.contains(limb)) visit(of_side, std::string(limb), std::string(side) + "." + std::string(limb));
  }
}

std::vector<std::string> all_limbs() {
  std::vector<std::string> names(std::begin(kTrunkNames), std::end(kTrunkNames));
  for (const std::string_view side : kSideNames)
    for (const std::string_view limb : kLimbNames) names.push_back(std::string(side) + "." + std::string(limb));
  return names;
}

void require_limb(const std::string& joint, const std::string& limb) {
  const std::vector<std::string> known = all_limbs();
  if (std::ranges::count(known, limb) != 0) return;
  const std::vector<std::string_view> names(known.begin(), known.end());
  throw Failure("cannot be '" + limb + "', which is no limb", "joint '" + joint + "'",
                document::did_you_mean(limb, names,
                                       "write pelvis, head, left.hip and the like: docs/model-format.md names them"));
}

}  // namespace

void name_limb(document::Json& model, const std::string& joint, const std::string& limb) {
  require_limb(joint, limb);
  forget_limb(model, joint);
  const std::size_t dot = limb.find('.');
  document::Json& limbs = model["limbs"];
  if (dot == std::string::npos)
    limbs[limb] = joint;
  else
    limbs[limb.substr(0, dot)][limb.substr(dot + 1)] = joint;
}

void forget_limb(document::Json& model, const std::string& joint) {
  const std::string limb = limb_of(model, joint);
  if (limb.empty()) return;
  document::Json& limbs = model["limbs"];
  const std::size_t dot = limb.find('.');
  if (dot == std::string::npos) {
    limbs.erase(limb);
  } else {
    const std::string side = limb.substr(0, dot);
    limbs[side].erase(limb.substr(dot + 1));
    if (limbs[side].empty()) limbs.erase(side);
  }
  if (limbs.empty()) model.erase("limbs");
}

void rename_limb(document::Json& model, const std::string& from, const std::string& to) {
  for_each_limb(model, [&](document::Json& limbs, const std::string& key, const std::string&) {
    if (limbs[key] == from) limbs[key] = to;
  });
}

std::string limb_of(const document::Json& model, const std::string& joint) {
  std::string found;
  for_each_limb(model, [&](const document::Json& limbs, const std::string& key, const std::string& limb) {
    if (limbs[key] == joint) found = limb;
  });
  return found;
}

std::string joint_that_is(const document::Json& model, const std::string& limb) {
  std::string found;
  for_each_limb(model, [&](const document::Json& limbs, const std::string& key, const std::string& name) {
    if (name == limb) found = limbs[key];
  });
  return found;
}

}  // namespace mars::modeler
