#include "host/content/importer/limbs/limb_names.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

#include "host/content/importer/limbs/conventions.h"

namespace mars::importer {
namespace {

using modeler::kNone;
using modeler::Limb;
using modeler::Side;
using modeler::Trunk;

// The name without a number at its end, "_07", and that number; the whole name where it has none.
std::pair<std::string, std::string> without_number(const std::string& name) {
  std::size_t end = name.size();
  while (end > 0 && std::isdigit(static_cast<unsigned char>(name[end - 1]))) --end;
  if (end == name.size() || end < 2 || name[end - 1] != '_') return {name, ""};
  return {name.substr(0, end - 1), name.substr(end)};
}

// Sketchfab numbers all joints of a file: "mixamorig:Hips_01".
bool are_numbered(const FigureTree& tree) {
  std::size_t named = 0, numbered = 0;
  std::set<std::string> numbers;
  for (const TreeJoint& joint : tree) {
    named += !joint.name.empty();
    const std::string number = without_number(joint.name).second;
    numbered += !number.empty() && numbers.insert(number).second;
  }
  return numbered >= 6 && 4 * numbered >= 3 * named;
}

// Of names to joints.
class Names {
 public:
  explicit Names(const FigureTree& tree) : tree_(tree) {
    const bool numbered = are_numbered(tree);
    for (std::size_t joint = 0; joint < tree.size(); ++joint) {
      const std::string& name = tree[joint].name;
      const std::string letters = plain_letters(numbered ? without_number(name).first : name);
      const auto [known, is_new] = joints_.try_emplace(letters, joint);
      if (!is_new && tree[joint].is_bone && !tree[known->second].is_bone) known->second = joint;
    }
  }

  // What precedes names that end with one of the pattern's.
  std::set<std::string> prefixes(std::string_view pattern, std::string_view side) const {
    std::set<std::string> prefixes;
    for (const std::string& ending : alternatives(pattern, side))
      for (const auto& [name, joint] : joints_)
        if (name.ends_with(ending)) prefixes.insert(name.substr(0, name.size() - ending.size()));
    return prefixes;
  }

  std::size_t find(const std::string& prefix, std::string_view pattern, std::string_view side) const {
    for (const std::string& name : alternatives(pattern, side))
      if (const auto found = joints_.find(prefix + name); found != joints_.end()) return found->second;
    return kNone;
  }

 private:
  static std::vector<std::string> alternatives(std::string_view pattern, std::string_view side) {
    std::vector<std::string> all;
    while (!pattern.empty()) {
      const std::size_t end = std::min(pattern.find('|'), pattern.size());
      std::string name(pattern.substr(0, end));
      if (const std::size_t at = name.find('%'); at != std::string::npos) name.replace(at, 1, side);
      all.push_back(name);
      pattern.remove_prefix(std::min(end + 1, pattern.size()));
    }
    return all;
  }

  const FigureTree& tree_;
  std::map<std::string, std::size_t> joints_;
};

LimbDraft draft_of(const Names& names, const Convention& convention, const std::string& prefix) {
  LimbDraft draft;
  draft.by = "names of " + std::string(convention.name);
  draft.of(Trunk::pelvis) = names.find(prefix, convention.pelvis, "");
  draft.of(Trunk::neck) = names.find(prefix, convention.neck, "");
  draft.of(Trunk::head) = names.find(prefix, convention.head, "");
  for (std::size_t limb = 0; limb < convention.limbs.size(); ++limb) {
    draft.of(Limb(limb), Side::left) = names.find(prefix, convention.limbs[limb], convention.left);
    draft.of(Limb(limb), Side::right) = names.find(prefix, convention.limbs[limb], convention.right);
  }
  return draft;
}

bool is_figure(const LimbDraft& draft) {
  return (draft.has_both(Limb::hip) && draft.has_both(Limb::knee)) ||
         (draft.has_both(Limb::shoulder) && draft.has_both(Limb::elbow));
}

// Bones weigh more than joints that nothing follows: a rig has several sets of bones.
std::size_t worth(const FigureTree& tree, const LimbDraft& draft) {
  std::size_t worth = 0;
  const auto add = [&](std::size_t joint) { worth += joint == kNone ? 0 : tree[joint].is_bone ? 3 : 2; };
  std::ranges::for_each(draft.limbs.trunk, add);
  for (const auto& side : draft.limbs.sides) std::ranges::for_each(side, add);
  return worth;
}

}  // namespace

std::string plain_letters(std::string_view name) {
  std::string letters;
  for (const char letter : name)
    if (std::isalnum(static_cast<unsigned char>(letter)))
      letters += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return letters;
}

std::optional<LimbDraft> limbs_by_names(const FigureTree& tree) {
  const Names names(tree);
  std::optional<LimbDraft> best;
  std::size_t most = 0;
  for (const Convention& convention : conventions()) {
    std::set<std::string> prefixes = names.prefixes(convention.limbs[0], convention.left);
    prefixes.merge(names.prefixes(convention.limbs[4], convention.left));
    for (const std::string& prefix : prefixes) {
      LimbDraft draft = draft_of(names, convention, prefix);
      const std::size_t worth = importer::worth(tree, draft);
      if (!is_figure(draft) || worth <= most) continue;
      most = worth;
      best = std::move(draft);
    }
  }
  return best;
}

}  // namespace mars::importer
