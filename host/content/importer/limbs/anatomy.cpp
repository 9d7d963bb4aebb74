#include "host/content/importer/limbs/anatomy.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <initializer_list>

#include "host/content/elementary/elementary.h"
#include "host/content/modeler/frames.h"

namespace mars::importer {
namespace {

using modeler::kNone;
using modeler::Limb;
using modeler::Limits;
using modeler::Side;
using modeler::Trunk;

// Degrees from the neutral position: a body that stands, its arms hanging, palms to the thighs. Of the left side. x is
// about the direction forward: positive raises a left arm or leg to the side. y is about that to the left: positive
// takes what hangs back and nods what stands forward. z is about the bone, upward: positive turns to the left.
//
// AAOS: American Academy of Orthopaedic Surgeons, Joint Motion: Method of Measuring and Recording, 1965. CDC: Soucie et
// al., Range of motion measurements, Haemophilia 17 (2011) 500-507: the CDC's normal joint range of motion study.
// Where joints share what was measured of all together, as those of the back do, each has its part of it.
struct Range {
  Limits x, y, z;
};

constexpr Limits kNo{0, 0};

// CDC: flexion 132, the mean of men's 130 and women's 134 from 20 to 44 years. AAOS: extension 30; abduction 45,
// adduction 30; rotation 45 to either side.
constexpr Range kHip{{-30, 45}, {-132, 30}, {-45, 45}};
// CDC: flexion 140, the mean of men's 138 and women's 142 from 20 to 44 years.
constexpr Range kKnee{kNo, {0, 140}, kNo};
// AAOS: plantar flexion 50; inversion 35, eversion 15. Dorsiflexion 40 with the weight on the foot, as in squats
// (Bennell et al., Australian Journal of Physiotherapy 44 (1998) 175-180), twice that of a hanging foot. The foot
// turns in and out by about 20.
constexpr Range kAnkle{{-35, 15}, {-40, 50}, {-20, 20}};
// AAOS, the great toe: extension 70, flexion 45.
constexpr Range kToes{kNo, {-70, 45}, kNo};
// AAOS: abduction 180; flexion 180, extension 60; rotation 70 inward, 90 outward. Adduction across the body 50.
constexpr Range kShoulder{{-50, 180}, {-180, 60}, {-70, 90}};
// AAOS, of an arm that is held out to the side: 135 forward, 45 back.
constexpr Limits kHeldOut{-135, 45};
// AAOS: flexion 150; the forearm turns 80 inward and outward.
constexpr Range kElbow{kNo, {-150, 0}, {-80, 80}};
// AAOS: flexion 80, extension 70; 20 to the thumb's side, 30 to the other.
constexpr Range kWrist{{-80, 70}, {-20, 30}, kNo};
// AAOS, of the back: flexion 80, extension 30, 35 to either side, rotation 45.
constexpr Range kBack{{-35, 35}, {-30, 80}, {-45, 45}};
// AAOS, of the neck: flexion 45, extension 45, 45 to either side, rotation 60.
constexpr Range kNeck{{-45, 45}, {-45, 45}, {-60, 60}};
// AAOS, of the shoulder girdle: elevation 40, depression 10; 20 forward and back.
constexpr Range kCollar{{-10, 40}, kNo, {-20, 20}};
// Joints within a bone, as rigs have them beside their limbs, only twist it: the forearm's 80 are the most.
constexpr Range kTwist{kNo, kNo, {-80, 80}};

constexpr double kArmIsHeldOut = 45;  // degrees from hanging
constexpr double kBentElbow = 0.2;    // sine of the angle from which an elbow is bent at rest, as for motions
constexpr double kMostTwist = 120;    // degrees, the same
constexpr double kHardlyUpright = 0.1;
constexpr double kFourLegs = 0.35;  // of the hips' height over the feet: as low as that the wrists are feet

Limits mirrored(const Limits& limits) { return {-limits.upper, -limits.lower}; }

Range of_side(Range range, Side side) {
  return side == Side::left ? range : Range{mirrored(range.x), range.y, mirrored(range.z)};
}

Limits part_of(const Limits& limits, double count) { return {limits.lower / count, limits.upper / count}; }
Range part_of(const Range& range, double count) {
  return {part_of(range.x, count), part_of(range.y, count), part_of(range.z, count)};
}

// Numbers of a joint that rests at `rest` of the neutral position; at rest every joint is within its limits.
Limits from_rest(const Limits& limits, double rest) {
  const auto whole = [](double degrees) { return std::round(degrees) + 0.0; };
  return {std::min(whole(limits.lower - rest), 0.0), std::max(whole(limits.upper - rest), 0.0)};
}

class Anatomist {
 public:
  Anatomist(const FigureTree& tree, const modeler::Limbs& limbs) : tree_(tree), limbs_(limbs), all_(tree.size()) {}

  std::vector<std::optional<JointAnatomy>> find() {
    if (!find_axes()) return all_;
    has_limits_ = !has_four_legs();
    add_trunk();
    for (const Side side : {Side::left, Side::right}) {
      add_leg(side);
      add_arm(side);
    }
    return std::move(all_);
  }

 private:
  std::size_t joint(Limb limb, Side side) const { return limbs_.of(limb, side); }
  glm::dvec3 place(std::size_t joint) const { return tree_[joint].place; }

  // Forward, left and up, as motions find them.
  bool find_axes() {
    const std::size_t left = joint(Limb::hip, Side::left), right = joint(Limb::hip, Side::right);
    if (left == kNone || right == kNone) return false;
    const glm::dvec3 across = place(left) - place(right), flat(across.x, across.y, 0);
    if (!(glm::length(flat) > kHardlyUpright * glm::length(across))) return false;
    axes_[1] = glm::normalize(flat);
    axes_[2] = {0, 0, 1};
    axes_[0] = glm::cross(axes_[1], axes_[2]);
    return true;
  }

  bool has_four_legs() const {
    const std::size_t hip = joint(Limb::hip, Side::left), wrist = joint(Limb::wrist, Side::left);
    double floor = place(hip).z;
    for (const TreeJoint& each : tree_) floor = std::min(floor, each.place.z);
    return wrist != kNone && place(wrist).z - floor < kFourLegs * (place(hip).z - floor);
  }

  void add(std::size_t number, const glm::dmat3& axes, const Range& range, const glm::dvec3& rest = glm::dvec3(0)) {
    if (number == kNone) return;
    all_[number] = JointAnatomy{axes, {}};
    if (has_limits_)
      all_[number]->limits = {from_rest(range.x, rest.x), from_rest(range.y, rest.y), from_rest(range.z, rest.z)};
  }

  std::size_t first_of(std::initializer_list<Trunk> parts) const {
    for (const Trunk part : parts)
      if (limbs_.of(part) != kNone) return limbs_.of(part);
    return kNone;
  }

  // All joints of the back bend, limbs or not, and all of the neck.
  void add_trunk() {
    const std::size_t pelvis = limbs_.of(Trunk::pelvis), chest = first_of({Trunk::chest, Trunk::spine});
    const std::size_t head = first_of({Trunk::head, Trunk::neck});
    if (pelvis != kNone) all_[pelvis] = JointAnatomy{axes_, {}};
    if (pelvis != kNone && chest != kNone) add_share(without_legs(way_down(tree_, pelvis, chest)), kBack);
    if (head == kNone) return;
    const std::size_t below = chest != kNone ? chest : pelvis;
    add_share(below == kNone ? std::vector{head} : way_down(tree_, below, head), kNeck);
  }

  std::vector<std::size_t> without_legs(std::vector<std::size_t> joints) const {
    const std::size_t hip = joint(Limb::hip, Side::left);
    std::erase_if(joints, [&](std::size_t each) { return is_at_or_below(tree_, hip, each); });
    return joints;
  }

  void add_share(const std::vector<std::size_t>& joints, const Range& range) {
    for (const std::size_t each : joints) add(each, axes_, part_of(range, double(joints.size())));
  }

  // What lies between two limbs.
  void add_between(std::size_t above, std::size_t below, const glm::dmat3& axes, const Range& range) {
    if (above == kNone || below == kNone) return;
    for (const std::size_t each : way_down(tree_, above, below))
      if (each != below) add(each, axes, range);
  }

  // From one limb to another; down where the other is unknown.
  glm::dvec3 bone(std::size_t from, std::size_t to) const {
    if (from == kNone || to == kNone || !(glm::distance(place(from), place(to)) > 0)) return -axes_[2];
    return glm::normalize(place(to) - place(from));
  }

  // Degrees by which what hangs is forward, and by which it is held out to the left.
  double forward(const glm::dvec3& bone) const {
    return glm::degrees(elementary::atan2(glm::dot(bone, axes_[0]), -glm::dot(bone, axes_[2])));
  }
  double aside(const glm::dvec3& bone) const {
    return glm::degrees(elementary::atan2(glm::dot(bone, axes_[1]), -glm::dot(bone, axes_[2])));
  }

  // The axes turned so, by the least, that z is along the bone, away from where it hangs.
  glm::dmat3 along(const glm::dvec3& bone) const {
    const glm::dvec3 down = -axes_[2], axis = glm::cross(down, bone);
    const double sine = glm::length(axis), cosine = glm::dot(down, bone);
    return sine < 1e-9 ? axes_ : modeler::rotation(axis / sine, elementary::atan2(sine, cosine)) * axes_;
  }

  void add_leg(Side side) {
    const std::size_t hip = joint(Limb::hip, side), knee = joint(Limb::knee, side), ankle = joint(Limb::ankle, side);
    const glm::dvec3 thigh = bone(hip, knee == kNone ? ankle : knee), shin = bone(knee, ankle);
    add(hip, along(thigh), of_side(kHip, side), {aside(thigh), -forward(thigh), 0});
    add_between(hip, knee, along(thigh), kTwist);
    add_between(knee, ankle, along(shin), kTwist);
    if (knee != kNone && ankle != kNone) add_knee(knee, side, thigh, shin);
    add(ankle, axes_, of_side(kAnkle, side));
    add(joint(Limb::toes, side), axes_, kToes);
  }

  void add_knee(std::size_t knee, Side side, const glm::dvec3& thigh, const glm::dvec3& shin) {
    add(knee, along(thigh), of_side(kKnee, side), {0, forward(thigh) - forward(shin), 0});
  }

  // Of an arm that would hang, the way its forearm is bent at rest, in degrees; the front is 0.
  struct Bend {
    double by = 0, aside = 0;
  };

  static Bend bend_of(const glm::dmat3& axes, const glm::dvec3& forearm) {
    const glm::dvec3 hanging = glm::transpose(axes) * forearm;
    const double out = elementary::hypot(hanging.x, hanging.y),
                 aside = glm::degrees(elementary::atan2(hanging.y, hanging.x));
    if (out < kBentElbow || std::abs(aside) > kMostTwist)
      return {glm::degrees(elementary::atan2(hanging.x, -hanging.z)), 0};
    return {glm::degrees(elementary::atan2(out, -hanging.z)), aside};
  }

  // The forearm turns about the axis about which it is bent at rest; what that differs from an arm that hangs, the
  // upper arm is twisted.
  void add_arm(Side side) {
    const std::size_t shoulder = joint(Limb::shoulder, side), elbow = joint(Limb::elbow, side);
    const std::size_t wrist = joint(Limb::wrist, side);
    const glm::dvec3 upper = bone(shoulder, elbow);
    const glm::dmat3 axes = along(upper);
    const Bend bend = elbow == kNone || wrist == kNone ? Bend{} : bend_of(axes, bone(elbow, wrist));
    const double held_out = aside(upper);
    const bool is_held_out = std::abs(held_out) > kArmIsHeldOut;
    Range range = of_side(kShoulder, side);
    if (is_held_out) range.y = kHeldOut;
    add(shoulder, axes, range, {held_out, is_held_out ? 0 : -forward(upper), bend.aside});
    const glm::dmat3 hinged = axes * modeler::rotation_by_degrees({0, 0, 1}, bend.aside);
    add_between(first_of({Trunk::chest, Trunk::spine}), shoulder, axes_, of_side(kCollar, side));
    add_between(shoulder, elbow, axes, kTwist);
    add_between(elbow, wrist, along(bone(elbow, wrist)), kTwist);
    add(elbow, hinged, of_side(kElbow, side), {0, -bend.by, 0});
    add(wrist, hinged, of_side(kWrist, side));
  }

  const FigureTree& tree_;
  const modeler::Limbs& limbs_;
  glm::dmat3 axes_{1};  // forward, left, up
  bool has_limits_ = true;
  std::vector<std::optional<JointAnatomy>> all_;
};

}  // namespace

std::vector<std::optional<JointAnatomy>> anatomy_of(const FigureTree& tree, const modeler::Limbs& limbs) {
  return Anatomist(tree, limbs).find();
}

}  // namespace mars::importer
