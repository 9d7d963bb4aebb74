#include "host/content/modeler/sides.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <glm/geometric.hpp>
#include <string_view>

#include "host/content/modeler/frames.h"

namespace mars::modeler {
namespace {

struct SideWord {
  std::string_view left, right;
  bool may_stand_anywhere;  // else only at the end, behind . _ or -
};

constexpr SideWord kWords[] = {
    {"left", "right", true}, {"Left", "Right", true}, {"LEFT", "RIGHT", true}, {"l", "r", false}, {"L", "R", false}};

bool is_letter(const std::string& name, std::size_t at) {
  return at < name.size() && std::isalpha(static_cast<unsigned char>(name[at])) != 0;
}

// A word of its own, such as in left-arm, arm.left and LeftArm; not in "cleft" or "leftover".
bool stands_alone(const std::string& name, std::size_t at, std::size_t size) {
  const bool begins = at == 0 || !is_letter(name, at - 1) || std::isupper(static_cast<unsigned char>(name[at])) != 0;
  const bool ends = !is_letter(name, at + size) || std::isupper(static_cast<unsigned char>(name[at + size])) != 0;
  return begins && ends;
}

bool ends_it(const std::string& name, std::size_t at, std::size_t size) {
  return at > 0 && at + size == name.size() && std::string_view(".-_").find(name[at - 1]) != std::string_view::npos;
}

struct SideInName {
  Side side;
  std::size_t at, size;
  std::string_view instead;
};

std::optional<SideInName> side_in(const std::string& name) {
  for (const SideWord& word : kWords)
    for (const Side side : {Side::left, Side::right}) {
      const std::string_view text = side == Side::left ? word.left : word.right;
      const std::size_t at = name.rfind(text);
      if (at == std::string::npos) continue;
      if (word.may_stand_anywhere ? stands_alone(name, at, text.size()) : ends_it(name, at, text.size()))
        return SideInName{side, at, text.size(), side == Side::left ? word.right : word.left};
    }
  return std::nullopt;
}

// How near joints must stand to be each other's mirror image, or in the middle.
double tolerance_of(const std::vector<Axes>& rest) {
  double farthest = 1e-6;
  for (const Axes& axes : rest) farthest = std::max(farthest, glm::length(axes.place));
  return farthest * 1e-4;
}

class Pairing {
 public:
  explicit Pairing(const Model& model)
      : model_(model), sides_(sides_of(model)), rest_(rest_frames(model)), found_(model.joints.size(), kNone) {}

  std::vector<std::size_t> find() {
    pair_limbs();
    for (std::size_t joint = 0; joint < found_.size(); ++joint) pair_name(joint);
    for (std::size_t joint = 0; joint < found_.size(); ++joint) pair_place(joint);
    return found_;
  }

 private:
  void pair(std::size_t one, std::size_t two) {
    if (one == kNone || two == kNone || one == two || found_[one] != kNone || found_[two] != kNone) return;
    found_[one] = two;
    found_[two] = one;
  }

  void pair_limbs() {
    const auto& [left, right] = model_.limbs.sides;
    for (std::size_t limb = 0; limb < left.size(); ++limb) pair(left[limb], right[limb]);
  }

  void pair_name(std::size_t joint) {
    if (!sides_[joint] || found_[joint] != kNone) return;
    const std::string name = other_side_name(model_.joints[joint].name);
    for (std::size_t each = 0; each < found_.size() && !name.empty(); ++each)
      if (model_.joints[each].name == name) pair(joint, each);
  }

  void pair_place(std::size_t joint) {
    if (!sides_[joint] || found_[joint] != kNone) return;
    const glm::dvec3 image = rest_[joint].place * glm::dvec3(1, -1, 1);
    for (std::size_t each = 0; each < found_.size(); ++each)
      if (found_[each] == kNone && sides_[each] == other(*sides_[joint]) &&
          glm::length(rest_[each].place - image) < tolerance_of(rest_))
        pair(joint, each);
  }

  const Model& model_;
  std::vector<std::optional<Side>> sides_;
  std::vector<Axes> rest_;
  std::vector<std::size_t> found_;
};

}  // namespace

std::string name_of(Side side) { return side == Side::left ? "left" : "right"; }

std::string other_side_name(const std::string& name) {
  const auto found = side_in(name);
  if (!found) return "";
  std::string other = name;
  return other.replace(found->at, found->size, found->instead);
}

std::vector<std::optional<Side>> sides_of(const Model& model) {
  std::vector<std::optional<Side>> sides(model.joints.size());
  for (const Side side : {Side::left, Side::right})
    for (const std::size_t joint : model.limbs.sides[static_cast<std::size_t>(side)])
      if (joint != kNone) sides[joint] = side;
  const std::vector<Axes> rest = rest_frames(model);
  const double tolerance = tolerance_of(rest);
  for (std::size_t joint = 0; joint < sides.size(); ++joint) {
    if (sides[joint] || std::ranges::count(model.limbs.trunk, joint)) continue;
    const std::size_t parent = model.joints[joint].parent;
    if (const auto named = side_in(model.joints[joint].name))
      sides[joint] = named->side;
    else if (parent != kNone && sides[parent])
      sides[joint] = sides[parent];
    else if (std::abs(rest[joint].place.y) > tolerance)
      sides[joint] = rest[joint].place.y > 0 ? Side::left : Side::right;
  }
  return sides;
}

std::vector<std::size_t> counterparts_of(const Model& model) { return Pairing(model).find(); }

}  // namespace mars::modeler
