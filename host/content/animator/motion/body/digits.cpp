#include "host/content/animator/motion/body/digits.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <map>
#include <optional>

#include "host/content/animator/motion/body/finger_names.h"
#include "host/content/animator/motion/body/reach.h"
#include "host/content/animator/motion/body/surface.h"
#include "host/content/elementary/elementary.h"

namespace mars::motion {
namespace {

// Degrees from straight, of a finger's joints and a thumb's; and of the thumb's first one from how it is drawn.
constexpr double kMostFinger[] = {85, 100, 75}, kMostThumb[] = {40, 60, 75};
constexpr double kThumbBack = -20, kFingerBack = -5;  // how far the first joint opens
constexpr double kSame = 0.94, kSameThumb = 0.8;      // cosines: an axis of a joint is the hinge
constexpr int kPads = 4;                              // of a phalanx

// Signed, in degrees, about the hinge.
double bend_between(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& hinge) {
  return glm::degrees(elementary::atan2(glm::dot(glm::cross(from, to), hinge), glm::dot(from, to)));
}

// Joints of one finger, and where it ends.
struct Row {
  std::vector<std::size_t> joints;
  std::string finger;
  glm::dvec3 tip;
};

class FindingDigits {
 public:
  FindingDigits(const modeler::Model& model, const Hand& hand, const glm::dvec3& thing)
      : model_(model), hand_(hand), drawn_(drawn_posture(model)), thing_(place(hand.end) + thing) {
    for (std::size_t joint = 0; joint < model.joints.size(); ++joint)
      if (modeler::is_at_or_below(model.joints, joint, hand.end)) points_[joint];
    const Surface surface = surface_of(
        model, [&](std::size_t joint) { return frame_in(model, drawn_, joint); }, kCoarseGrid);
    for (const SurfacePoint& point : surface.points)
      if (const auto below = points_.find(point.joint); below != points_.end())
        below->second.push_back(point.place - place(point.joint));
    rows_ = rows();
  }

  std::vector<Digit> found() const {
    const std::size_t thumb = thumb_row();
    const glm::dvec3 inward = palm_normal(thumb);
    std::vector<Digit> digits;
    for (std::size_t row = 0; row < rows_.size(); ++row) digits.push_back(digit_of(rows_[row], row == thumb, inward));
    return digits;
  }

 private:
  glm::dvec3 place(std::size_t joint) const { return frame_in(model_, drawn_, joint).place; }

  std::vector<Row> rows() const {
    std::vector<Row> rows;
    for (const std::size_t joint : finger_joints_below(model_, hand_.end)) {
      const std::string finger = finger_of(model_.joints[joint].name);
      const auto known = std::ranges::find_if(rows, [&](const Row& row) {
        return row.joints.back() == model_.joints[joint].parent && row.finger == finger;
      });
      if (known == rows.end())
        rows.push_back({{joint}, finger, {}});
      else
        known->joints.push_back(joint);
    }
    for (Row& row : rows) end(row);
    std::erase_if(rows, [](const Row& row) { return row.joints.empty(); });
    return rows;
  }

  // The last joints of some programs are but the tips.
  void end(Row& row) const {
    std::optional<glm::dvec3> tip;
    while (!row.joints.empty() && points_.at(row.joints.back()).empty()) {
      tip = place(row.joints.back());
      row.joints.pop_back();
    }
    if (row.joints.empty()) return;
    glm::dvec3 sum(0);
    const std::vector<glm::dvec3>& points = points_.at(row.joints.back());
    for (const glm::dvec3& point : points) sum += point;
    row.tip = tip.value_or(place(row.joints.back()) + sum / double(points.size()));
  }

  // By its name, or the one that begins nearest to the wrist; none: there is one finger alone.
  std::size_t thumb_row() const {
    std::size_t nearest = modeler::kNone;
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      if (rows_[row].finger == "thumb") return row;
      if (rows_.size() > 1 && (nearest == modeler::kNone || along(row) < along(nearest))) nearest = row;
    }
    return nearest;
  }

  double along(std::size_t row) const { return glm::dot(place(rows_[row].joints[0]), hand_.fingers); }

  // Across the row of the fingers' roots.
  glm::dvec3 palm_normal(std::size_t thumb) const {
    std::vector<glm::dvec3> roots;
    for (std::size_t row = 0; row < rows_.size(); ++row)
      if (row != thumb) roots.push_back(place(rows_[row].joints[0]));
    if (roots.size() < 2) return hand_.palm;
    const glm::dvec3 normal = glm::cross(roots.back() - roots.front(), hand_.fingers);
    const double toward = glm::dot(normal, hand_.palm);
    return std::abs(toward) < 0.3 * glm::length(normal) ? hand_.palm
                                                        : glm::normalize(normal) * (toward < 0 ? -1.0 : 1.0);
  }

  Digit digit_of(const Row& row, bool is_thumb, const glm::dvec3& inward) const {
    const glm::dvec3 root = place(row.joints[0]), whole = row.tip - root;
    const glm::dvec3 way = glm::length(whole) > 1e-9 ? glm::normalize(whole) : hand_.fingers;
    const glm::dvec3 across = glm::cross(way, is_thumb ? thing_ - root : inward);
    const glm::dvec3 hinge = glm::normalize(glm::length(across) > 1e-9 ? across : glm::cross(way, hand_.palm));
    Digit digit;
    glm::dvec3 before = is_thumb ? way : hand_.fingers;
    for (std::size_t number = 0; number < row.joints.size(); ++number) {
      const std::size_t joint = row.joints[number];
      const glm::dvec3 next = number + 1 < row.joints.size() ? place(row.joints[number + 1]) : row.tip;
      const glm::dvec3 bone = next - place(joint);
      const glm::dvec3 along = glm::length(bone) > 1e-9 ? glm::normalize(bone) : before;
      Phalanx phalanx = hinged(joint, hinge, is_thumb ? kSameThumb : kSame);
      const double drawn = std::max(0.0, bend_between(before, along, phalanx.hinge));
      const double most = (is_thumb ? kMostThumb : kMostFinger)[number < 2 ? number : 2];
      const double back = number > 0 ? 0 : is_thumb ? kThumbBack : kFingerBack;
      phalanx.open = std::max(phalanx.open, back - drawn);
      phalanx.shut = std::max(phalanx.open, std::min(phalanx.shut, most - drawn));
      const bool is_last = number + 1 == row.joints.size();
      phalanx.pads = pads_of(joint, along, glm::cross(phalanx.hinge, along), is_last ? 0 : glm::length(bone));
      digit.phalanges.push_back(std::move(phalanx));
      before = along;
    }
    return digit;
  }

  // With the joint's own limits.
  Phalanx hinged(std::size_t number, const glm::dvec3& hinge, double same) const {
    const modeler::Joint& joint = model_.joints[number];
    const glm::dvec3 axes[] = {joint.x_axis, joint.y_axis, glm::normalize(glm::cross(joint.x_axis, joint.y_axis))};
    Phalanx phalanx{number, hinge, -1, 1, -180, 180, {}};
    if (joint.freedoms() == 0) phalanx.open = phalanx.shut = 0;
    double best = joint.freedoms() == 1 ? 0 : same;
    for (int axis = 0; axis < 3; ++axis) {
      const double cosine = glm::dot(axes[axis], hinge);
      const modeler::Limits& limits = joint.limits[static_cast<std::size_t>(axis)];
      if (!limits.free() || std::abs(cosine) < best) continue;
      best = std::abs(cosine);
      phalanx.axis = axis;
      phalanx.sign = cosine < 0 ? -1 : 1;
      phalanx.hinge = phalanx.sign * axes[axis];
      phalanx.open = cosine < 0 ? -limits.upper : limits.lower;
      phalanx.shut = cosine < 0 ? -limits.lower : limits.upper;
    }
    return phalanx;
  }

  // Along the bone; `length`: the bone's, or 0: as far as the surface.
  std::vector<Pad> pads_of(std::size_t joint, const glm::dvec3& along, const glm::dvec3& inside, double length) const {
    const std::vector<glm::dvec3>& points = points_.at(joint);
    if (length <= 0)
      for (const glm::dvec3& point : points) length = std::max(length, glm::dot(point, along));
    std::vector<Pad> pads;
    for (int i = 0; i < kPads; ++i) {
      const double at = (i + 0.5) / kPads * length;
      double radius = 0;
      for (const glm::dvec3& point : points)
        if (std::abs(glm::dot(point, along) - at) <= length / kPads) radius = std::max(radius, glm::dot(point, inside));
      if (radius > 0) pads.push_back({std::min(at, std::max(0.5 * length, length - radius)) * along, radius});
    }
    return pads;
  }

  const modeler::Model& model_;
  const Hand& hand_;
  Posture drawn_;
  glm::dvec3 thing_;                                       // in the model's frame
  std::map<std::size_t, std::vector<glm::dvec3>> points_;  // of what moves with each joint, from it
  std::vector<Row> rows_;
};

}  // namespace

std::vector<Digit> digits_of(const modeler::Model& model, const Hand& hand, const glm::dvec3& thing) {
  if (finger_joints_below(model, hand.end).empty()) return {};
  return FindingDigits(model, hand, thing).found();
}

glm::dvec3 bent(const modeler::Model& model, const Phalanx& phalanx, double degrees, const glm::dvec3& now) {
  const modeler::Joint& joint = model.joints[phalanx.joint];
  if (phalanx.axis < 0)
    return joint.freedoms() == 0 ? now
                                 : nearest_turns(joint, modeler::rotation_by_degrees(phalanx.hinge, degrees), now);
  glm::dvec3 numbers = now;
  numbers[phalanx.axis] = phalanx.sign * degrees;
  return numbers;
}

}  // namespace mars::motion
