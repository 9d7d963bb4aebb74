#include "host/content/importer/limbs/limb_shape.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace mars::importer {
namespace {

using modeler::kNone;
using modeler::Limb;
using modeler::Side;
using modeler::Trunk;

using Chain = std::vector<std::size_t>;

constexpr std::size_t kMostJoints = 5000, kMostChildren = 50;  // of what may be a figure
constexpr double kNearFloor = 0.15;                            // of the figure's height: how high a leg may end
constexpr double kLegsAlike = 0.08;                            // of the height: how far two legs may end from one level
constexpr double kArmsAlike = 0.15;                            // of the longer arm: how much their lengths may differ
constexpr double kLeastAside = 0.4;  // of a leg's distance from the middle: what is nearer carries the leg
constexpr double kFootLies = 0.7;    // sine of the slope below which a bone is a foot's
constexpr double kFootIsLow = 0.35;  // of the hip's height: where a foot may begin
constexpr double kLeastArm = 0.1;    // of the height
constexpr double kMore = 1.5;        // times: legs farther out in the tree are preferred if they are so much larger
constexpr double kPoints = 0.02;     // of the height: how far a foot points forward, or a knee

class Shape {
 public:
  explicit Shape(const FigureTree& tree)
      : tree_(tree), children_(tree.size()), lowest_(tree.size()), far_(tree.size()) {
    for (std::size_t joint = tree.size(); joint-- > 0;) {
      lowest_[joint] = place(joint).z;
      for (const std::size_t child : children_[joint]) {
        lowest_[joint] = std::min(lowest_[joint], lowest_[child]);
        far_[joint] = std::max(far_[joint], far_[child] + glm::distance(place(joint), place(child)));
      }
      if (tree[joint].parent != kNone) children_[tree[joint].parent].push_back(joint);
    }
    floor_ = highest_ = place(0).z;
    for (const TreeJoint& joint : tree) {
      if (!joint.is_bone) continue;
      floor_ = std::min(floor_, joint.place.z);
      highest_ = std::max(highest_, joint.place.z);
    }
  }

  std::optional<LimbDraft> find() {
    if (!(height() > 0) || !find_legs()) return std::nullopt;
    find_arms();
    find_head();
    if (!find_sides()) draft_.doubts.push_back("which side is left: taken as if it looked along -y");
    draft_.by = "its shape";
    draft_.is_guess = true;
    return std::move(draft_);
  }

 private:
  const glm::dvec3& place(std::size_t joint) const { return tree_[joint].place; }
  double height() const { return highest_ - floor_; }

  // Down from a joint, each time to the child that `better` prefers.
  Chain chain(std::size_t joint, const std::vector<double>& measure, bool least) const {
    Chain chain{joint};
    while (!children_[chain.back()].empty()) {
      const Chain& next = children_[chain.back()];
      const auto by = [&](std::size_t a, std::size_t b) { return measure[a] < measure[b]; };
      chain.push_back(least ? *std::ranges::min_element(next, by) : *std::ranges::max_element(next, by));
    }
    return chain;
  }

  // Two children of one joint that end near the floor on one level, as far from each other as any.
  bool find_legs() {
    double widest = 0;
    Chain legs[2];
    for (std::size_t joint = 0; joint < tree_.size(); ++joint)
      for (const std::size_t one : children_[joint])
        for (const std::size_t other : children_[joint]) {
          if (one >= other || !are_legs(one, other)) continue;
          const Chain a = chain(one, lowest_, true), b = chain(other, lowest_, true);
          const double width = glm::distance(glm::dvec2(place(a.back())), glm::dvec2(place(b.back())));
          const double size = std::min(far_[one], far_[other]);
          if (width * size <= (widest > 0 ? kMore : 1) * widest) continue;
          widest = width * size;
          legs[0] = a;
          legs[1] = b;
          draft_.of(Trunk::pelvis) = joint;
        }
    if (widest == 0) return false;
    const glm::dvec3 middle = 0.5 * (place(legs[0].back()) + place(legs[1].back()));
    return add_leg(legs[0], middle, Side::left) && add_leg(legs[1], middle, Side::right);
  }

  bool are_legs(std::size_t one, std::size_t other) const {
    return lowest_[one] - floor_ < kNearFloor * height() && lowest_[other] - floor_ < kNearFloor * height() &&
           std::abs(lowest_[one] - lowest_[other]) < kLegsAlike * height() && far_[one] > 2 * kNearFloor * height() &&
           far_[other] > 2 * kNearFloor * height();
  }

  // The hip is the first joint that is aside; the foot begins where the chain lies down; the knee is between them,
  // where it halves the leg best.
  bool add_leg(const Chain& leg, const glm::dvec3& middle, Side side) {
    const auto aside = [&](std::size_t joint) { return glm::distance(glm::dvec2(place(joint)), glm::dvec2(middle)); };
    std::size_t hip = 0;
    while (hip + 2 < leg.size() && aside(leg[hip]) < kLeastAside * aside(leg.back())) ++hip;
    std::size_t ankle = leg.size() - 1;
    for (std::size_t i = leg.size() - 1; i-- > hip + 1;) {
      const glm::dvec3 bone = place(leg[i + 1]) - place(leg[i]);
      const bool is_low = place(leg[i]).z - floor_ < kFootIsLow * (place(leg[hip]).z - floor_);
      if (is_low && std::abs(bone.z) < kFootLies * glm::length(bone)) ankle = i;
    }
    if (ankle == hip) return false;
    draft_.of(Limb::hip, side) = leg[hip];
    draft_.of(Limb::ankle, side) = leg[ankle];
    draft_.of(Limb::knee, side) = middle_of(leg, hip, ankle);
    if (ankle + 1 < leg.size()) draft_.of(Limb::toes, side) = leg[ankle + 1];
    return true;
  }

  // Of the joints between two of a chain the one whose ways to both differ least; kNone: there is none.
  std::size_t middle_of(const Chain& chain, std::size_t first, std::size_t last) const {
    std::size_t best = kNone;
    double least = 0;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double differ = std::abs(glm::distance(place(chain[first]), place(chain[i])) -
                                     glm::distance(place(chain[i]), place(chain[last])));
      if (best != kNone && differ >= least) continue;
      best = chain[i];
      least = differ;
    }
    return best;
  }

  bool is_of_legs(std::size_t joint) const {
    return is_at_or_below(tree_, joint, draft_.limbs.of(Limb::hip, Side::left)) ||
           is_at_or_below(tree_, joint, draft_.limbs.of(Limb::hip, Side::right)) ||
           is_at_or_below(tree_, draft_.limbs.of(Limb::hip, Side::left), joint) ||
           is_at_or_below(tree_, draft_.limbs.of(Limb::hip, Side::right), joint);
  }

  // The two like children of one joint that reach farthest to both sides.
  void find_arms() {
    double widest = 0;
    Chain arms[2];
    for (std::size_t joint = 0; joint < tree_.size(); ++joint)
      for (const std::size_t one : children_[joint])
        for (const std::size_t other : children_[joint]) {
          if (one == other || is_of_legs(one) || is_of_legs(other) || !are_arms(one, other)) continue;
          const double reach = std::min(far_[one], far_[other]);
          if (reach <= widest) continue;
          widest = reach;
          const bool is_left = to_left(place(farthest(one))) > to_left(place(farthest(other)));
          arms[is_left ? 0 : 1] = chain(one, far_, false);
          arms[is_left ? 1 : 0] = chain(other, far_, false);
        }
    if (widest == 0) return;
    add_arm(arms[0], Side::left);
    add_arm(arms[1], Side::right);
  }

  std::size_t farthest(std::size_t joint) const { return chain(joint, far_, false).back(); }

  // How far on the side of the leg that is the left for now.
  double to_left(const glm::dvec3& at) const {
    const glm::dvec3 hips[] = {place(draft_.limbs.of(Limb::hip, Side::left)),
                               place(draft_.limbs.of(Limb::hip, Side::right))};
    return glm::dot(glm::dvec2(at - 0.5 * (hips[0] + hips[1])), glm::normalize(glm::dvec2(hips[0] - hips[1])));
  }

  bool are_arms(std::size_t one, std::size_t other) const {
    const double longer = std::max(far_[one], far_[other]);
    const double a = to_left(place(farthest(one))), b = to_left(place(farthest(other)));
    return std::min(far_[one], far_[other]) > kLeastArm * height() &&
           std::abs(far_[one] - far_[other]) < kArmsAlike * longer && a * b < 0 &&
           std::abs(a + b) < kArmsAlike * (std::abs(a) + std::abs(b));
  }

  // The hand is where fingers part, or the end; the elbow halves the arm, whose first joint may be a collar bone.
  void add_arm(const Chain& arm, Side side) {
    std::size_t hand = arm.size() - 1;
    for (std::size_t i = arm.size(); i-- > 1;)
      if (children_[arm[i]].size() >= 2) hand = i;
    if (hand < 2) return add_short_arm(arm, side);
    std::size_t shoulder = 0, elbow = 1;
    double best = -1;
    for (std::size_t i = 0; i + 1 < hand; ++i)
      for (std::size_t j = i + 1; j < hand; ++j) {
        const double shorter =
            std::min(glm::distance(place(arm[i]), place(arm[j])), glm::distance(place(arm[j]), place(arm[hand])));
        // Of equal ones the later: a collar bone adds nothing.
        if (shorter < best) continue;
        best = shorter;
        shoulder = i;
        elbow = j;
      }
    draft_.of(Limb::shoulder, side) = arm[shoulder];
    draft_.of(Limb::elbow, side) = arm[elbow];
    draft_.of(Limb::wrist, side) = arm[hand];
  }

  void add_short_arm(const Chain& arm, Side side) {
    draft_.of(Limb::shoulder, side) = arm[0];
    if (arm.size() > 1) draft_.of(Limb::elbow, side) = arm[1];
  }

  // The highest joint that is of no limb; what carries it, above the arms, is the neck.
  void find_head() {
    const std::size_t shoulders[] = {draft_.limbs.of(Limb::shoulder, Side::left),
                                     draft_.limbs.of(Limb::shoulder, Side::right)};
    const std::size_t chest = shoulders[0] == kNone ? draft_.of(Trunk::pelvis) : common_joint(tree_, shoulders);
    if (chest == kNone) return;
    std::size_t highest = kNone;
    for (std::size_t joint = 0; joint < tree_.size(); ++joint) {
      if (joint == chest || is_of_legs(joint) || !is_at_or_below(tree_, joint, chest) || is_of_arms(joint, chest))
        continue;
      if (highest == kNone || place(joint).z > place(highest).z) highest = joint;
    }
    if (highest == kNone || place(highest).z < place(chest).z) return;
    const Chain way = way_down(tree_, chest, highest);
    draft_.of(Trunk::head) = way.size() > 1 ? way[1] : way[0];
    if (way.size() > 1) draft_.of(Trunk::neck) = way[0];
  }

  // Below the same child of the chest as a shoulder.
  bool is_of_arms(std::size_t joint, std::size_t chest) const {
    for (const Side side : {Side::left, Side::right}) {
      const std::size_t shoulder = draft_.limbs.of(Limb::shoulder, side);
      if (shoulder != kNone && is_at_or_below(tree_, joint, way_down(tree_, chest, shoulder).front())) return true;
    }
    return false;
  }

  // Of both legs together, where feet point, else where knees do.
  glm::dvec2 forward() const {
    glm::dvec2 feet(0), knees(0);
    for (const Side side : {Side::left, Side::right}) {
      const std::size_t hip = draft_.limbs.of(Limb::hip, side), knee = draft_.limbs.of(Limb::knee, side),
                        ankle = draft_.limbs.of(Limb::ankle, side), toes = draft_.limbs.of(Limb::toes, side);
      if (toes != kNone) feet += glm::dvec2(place(toes) - place(ankle));
      if (knee == kNone) continue;
      const glm::dvec3 leg = place(ankle) - place(hip);
      const double part = glm::dot(place(knee) - place(hip), leg) / glm::dot(leg, leg);
      knees += glm::dvec2(place(knee) - place(hip) - part * leg);
    }
    return glm::length(feet) > kPoints * height() ? feet : knees;
  }

  // Whether the figure shows which side is left.
  bool find_sides() {
    const glm::dvec3 left =
        place(draft_.limbs.of(Limb::hip, Side::left)) - place(draft_.limbs.of(Limb::hip, Side::right));
    glm::dvec2 ahead = forward();
    const bool shown = glm::length(ahead) > kPoints * height();
    if (!shown) ahead = {0, -1};
    if (-ahead.y * left.x + ahead.x * left.y < 0) std::swap(draft_.limbs.sides[0], draft_.limbs.sides[1]);
    return shown;
  }

  const FigureTree& tree_;
  std::vector<Chain> children_;
  std::vector<double> lowest_;  // of what hangs from a joint
  std::vector<double> far_;     // the longest way from a joint outwards
  double floor_ = 0, highest_ = 0;
  LimbDraft draft_;
};

}  // namespace

std::optional<LimbDraft> limbs_by_shape(const FigureTree& tree) {
  std::vector<std::size_t> children(tree.size());
  for (const TreeJoint& joint : tree)
    if (joint.parent != kNone) ++children[joint.parent];
  if (tree.empty() || tree.size() > kMostJoints || *std::ranges::max_element(children) > kMostChildren)
    return std::nullopt;
  return Shape(tree).find();
}

}  // namespace mars::importer
