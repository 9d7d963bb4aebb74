#include "host/content/modeler/review.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <set>
#include <string_view>

#include "host/content/document/fields.h"
#include "host/content/modeler/frames.h"

namespace mars::modeler {
namespace {

constexpr double kApart = 0.01;  // of the model's size: nearer limbs seem to touch

// How far `point` is outside the box, along its worst axis.
double outside(const Box& box, const glm::dvec3& point) {
  const glm::dvec3 distance = glm::max(box.min - point, point - box.max);
  return std::max({distance.x, distance.y, distance.z, 0.0});
}

double gap_between(const Box& a, const Box& b) {
  const glm::dvec3 gap = glm::max(a.min - b.max, b.min - a.max);
  return std::max({gap.x, gap.y, gap.z, 0.0});
}

std::string of(const Joint& joint) { return "joint '" + joint.name + "' "; }

class Review {
 public:
  explicit Review(const Model& model)
      : model_(model), bounds_(segment_rest_bounds(model)), children_(model.joints.size()) {
    for (const Joint& joint : model.joints) {
      if (joint.parent != kNone) ++children_[joint.parent];
      if (!joint.segment) continue;
      for (const Bone& bone : joint.segment->bones) bones_.insert(bone.joint);
    }
    if (const auto all = rest_bounds(model)) size_ = glm::length(all->max - all->min);
  }

  std::vector<std::string> doubts() {
    for (std::size_t number = 0; number < model_.joints.size(); ++number) {
      doubt_emptiness(number);
      doubt_rest(model_.joints[number]);
      if (!doubt_place(number)) doubt_gap(number);
    }
    doubt_roots();
    doubt_freedom();
    doubt_stance();
    doubt_unused();
    return std::move(doubts_);
  }

 private:
  void doubt_emptiness(std::size_t number) {
    const Joint& joint = model_.joints[number];
    if (!joint.segment && children_[number] == 0 && !bones_.contains(number))
      doubts_.push_back(of(joint) + "has no segment and carries no joint: nothing of it is seen; give it a shape");
  }

  void doubt_rest(const Joint& joint) {
    const glm::dvec3 rest = joint.rest();
    for (int axis = 0; axis < 3; ++axis)
      if (rest[axis] != 0 && joint.limits[axis].free())
        doubts_.push_back(of(joint) + "rests at " + document::shown(rest[axis]) + " degrees about " + "xyz"[axis] +
                          ", for its limits leave 0 out");
  }

  // Children hang on their parent's segment. True if a doubt was added.
  bool doubt_place(std::size_t number) {
    const Joint& joint = model_.joints[number];
    if (joint.parent == kNone || !model_.joints[joint.parent].segment) return false;
    const Joint& parent = model_.joints[joint.parent];
    const Box& sbb = parent.segment->sbb;
    const glm::dvec3 place = glm::inverse(segment_axes(parent)) * joint.place;
    const double far = outside(sbb, place);
    if (far <= 0.25 * glm::length(sbb.max - sbb.min)) return false;
    const bool mirrored = outside(sbb, -place) == 0;
    if (!mirrored) return false;
    doubts_.push_back(of(joint) + "is placed " + short_text(far) + " outside the segment of '" + parent.name +
                      "', whose sbb lies on the other side: mirror that sbb or the place");
    return true;
  }

  void doubt_gap(std::size_t number) {
    const Joint& joint = model_.joints[number];
    if (!bounds_[number]) return;
    std::size_t ancestor = joint.parent;
    while (ancestor != kNone && !bounds_[ancestor]) ancestor = model_.joints[ancestor].parent;
    if (ancestor == kNone) return;
    const double gap = gap_between(*bounds_[number], *bounds_[ancestor]);
    if (gap > kApart * size_)
      doubts_.push_back(of(joint) + "has its segment " + short_text(gap) + " away from that of '" +
                        model_.joints[ancestor].name + "' at rest: move its place or its sbb, if they shall touch");
  }

  // A joint alone beside a figure may have lost its parent; a floor of tiles, where none carries another, has not.
  void doubt_roots() {
    const auto carries = [&](std::size_t number) { return children_[number] > 0; };
    std::size_t root = 0;
    while (root < children_.size() && !carries(root)) ++root;
    if (root == children_.size()) return;
    while (model_.joints[root].parent != kNone) root = model_.joints[root].parent;
    for (std::size_t number = 0; number < children_.size(); ++number)
      if (model_.joints[number].parent == kNone && !carries(number))
        doubts_.push_back(of(model_.joints[number]) + "hangs on nothing, beside '" + model_.joints[root].name +
                          "'; give it a parent if it belongs to it");
  }

  void doubt_freedom() {
    const auto turns = [](const Joint& joint) { return joint.freedoms() > 0; };
    const auto hangs = [](const Joint& joint) { return joint.parent != kNone; };
    if (std::ranges::any_of(model_.joints, hangs) && std::ranges::none_of(model_.joints, turns))
      doubts_.emplace_back("no joint can turn: give those that shall some limits");
  }

  // What is to walk stands on the floor, and its feet reach to where its hips make it look.
  void doubt_stance() {
    const std::size_t left = model_.limbs.of(Limb::hip, Side::left), right = model_.limbs.of(Limb::hip, Side::right);
    if (left == kNone || right == kNone) return;
    const double lowest = rest_bounds(model_).value_or(Box{}).min.z;
    if (std::abs(lowest) > kApart * size_)
      doubts_.push_back("the figure stands " + short_text(std::abs(lowest)) + (lowest < 0 ? " under" : " over") +
                        " the floor, z = 0, which commands take it to stand on: change the place of its root");
    const std::vector<Axes> frames = rest_frames(model_);
    const glm::dvec3 forward = glm::cross(frames[left].place - frames[right].place, glm::dvec3(0, 0, 1));
    for (const Side side : {Side::left, Side::right}) {
      const std::size_t ankle = model_.limbs.of(Limb::ankle, side);
      if (ankle == kNone || !bounds_[ankle]) continue;
      const glm::dvec3 middle = 0.5 * (bounds_[ankle]->min + bounds_[ankle]->max);
      if (glm::dot(middle - frames[ankle].place, forward) < -kApart * size_ * glm::length(forward))
        doubts_.push_back(of(model_.joints[ankle]) + "points backward: are left and right limbs exchanged?");
    }
  }

  void doubt_unused() {
    std::set<std::size_t> shapes;
    std::set<std::string_view> used, own;
    for (const Joint& joint : model_.joints) {
      if (!joint.segment) continue;
      shapes.insert(joint.segment->shape);
      used.insert(joint.segment->material);
    }
    for (std::size_t number = 0; number < model_.shapes.size(); ++number)
      if (!shapes.contains(number))
        doubts_.push_back("shape '" + model_.shapes[number].name + "' is used by no segment");
    for (const NamedMaterial& material : model_.materials) {
      own.insert(material.name);
      if (!used.contains(material.name)) doubts_.push_back("material '" + material.name + "' is used by no segment");
    }
    used.erase("");
    for (const std::string_view name : used)
      if (!own.contains(name))
        doubts_.push_back("material '" + std::string(name) +
                          "' is not the model's own: every film that uses the model must have it");
    if (shapes.empty()) doubts_.emplace_back("no joint has a segment: nothing is seen");
  }

  static std::string short_text(double number) { return document::formatted("%.3g", number); }

  const Model& model_;
  std::set<std::size_t> bones_;             // joints that skins follow
  std::vector<std::optional<Box>> bounds_;  // of each joint's segment at rest
  std::vector<std::size_t> children_;       // how many
  double size_ = 0;
  std::vector<std::string> doubts_;
};

}  // namespace

std::vector<std::string> doubts_about(const Model& model) { return Review(model).doubts(); }

}  // namespace mars::modeler
