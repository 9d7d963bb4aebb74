#include "host/content/animator/motion/body/arms.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include "host/content/animator/motion/body/stance.h"
#include "host/content/animator/motion/body/surface.h"
#include "host/content/elementary/elementary.h"

namespace mars::motion {
namespace {

constexpr double kOut = 30;        // degrees from hanging that an arm is drawn at rest
constexpr double kMostHang = 22;   // degrees: what is broader is touched
constexpr double kBelow = 0.4;     // of the arm, from where it shall be clear: above it grows from the body
constexpr double kInside = 0.6;    // of an arm's half width that counts: sleeves and hands give way
constexpr std::size_t kBands = 8;  // of the arm's length below that

using Bands = std::array<double, kBands>;

// Where a point at a depth below the shoulder is counted.
std::size_t band_of(double depth, double length) {
  const double share = (depth / length - kBelow) / (1 - kBelow);
  return share < 0 || share >= 1 ? kBands : static_cast<std::size_t>(share * kBands);
}

class BesideBody {
 public:
  BesideBody(const Body& body, modeler::Side side)
      : body_(body),
        side_(side),
        drawn_(drawn_posture(*body.model)),
        shoulder_(body.find(modeler::Limb::shoulder, side)),
        end_(body.find(modeler::Limb::wrist, side)) {
    const std::size_t elbow = body.find(modeler::Limb::elbow, side);
    if (end_ == modeler::kNone) end_ = elbow;
    length_ = glm::distance(place(shoulder_), place(elbow)) + glm::distance(place(elbow), place(end_));
  }

  // Degrees that the widest band needs.
  double degrees() const {
    if (length_ <= 0) return 0;
    const Bands body = widths_of_body(), arm = widths_of_arm();
    double most = 0;
    for (std::size_t band = 0; band < kBands; ++band) {
      const double depth = length_ * (kBelow + (1 - kBelow) * (double(band) + 0.5) / kBands);
      most = std::max(most, elementary::atan2(body[band] + kInside * arm[band], depth));
    }
    return glm::degrees(most);
  }

 private:
  glm::dvec3 place(std::size_t joint) const { return frame_in(*body_.model, drawn_, joint).place; }

  // Of points that `counts` chooses, how far each band reaches outward from below the shoulder, after `turn`.
  template <typename Counts>
  Bands reaches(const Counts& counts, const glm::dmat3& turn, double sign) const {
    Bands most{};
    const glm::dvec3 from = place(shoulder_);
    for (const glm::dvec3& point : points_of(*body_.model, drawn_, counts)) {
      const glm::dvec3 p = turn * (glm::transpose(body_.axes) * (point - from));
      if (const std::size_t band = band_of(-p.z, length_); band < kBands)
        most[band] = std::max(most[band], sign * sign_of(side_) * p.y);
    }
    return most;
  }

  Bands widths_of_body() const {
    const std::size_t other_shoulder = body_.find(modeler::Limb::shoulder, other(side_));
    return reaches(
        [&](std::size_t joint) {
          return !modeler::is_at_or_below(body_.model->joints, joint, shoulder_) &&
                 !modeler::is_at_or_below(body_.model->joints, joint, other_shoulder);
        },
        glm::dmat3(1), 1);
  }

  Bands widths_of_arm() const {
    return reaches([&](std::size_t joint) { return modeler::is_at_or_below(body_.model->joints, joint, shoulder_); },
                   hanging_shoulder(body_, side_, {0, 0, 0}), -1);
  }

  const Body& body_;
  modeler::Side side_;
  Posture drawn_;
  std::size_t shoulder_, end_;
  double length_ = 0;
};

}  // namespace

bool is_drawn_out(const Body& body, modeler::Side side) {
  const std::size_t shoulder = body.find(modeler::Limb::shoulder, side), elbow = body.find(modeler::Limb::elbow, side);
  if (shoulder == modeler::kNone || elbow == modeler::kNone) return false;
  const Posture drawn = drawn_posture(*body.model);
  const glm::dvec3 along = frame_in(*body.model, drawn, elbow).place - frame_in(*body.model, drawn, shoulder).place;
  return glm::dot(glm::normalize(along), body.axes[2]) > -elementary::cos(glm::radians(kOut));
}

double hang_beside(const Body& body, modeler::Side side) {
  if (body.find(modeler::Limb::shoulder, side) == modeler::kNone ||
      body.find(modeler::Limb::elbow, side) == modeler::kNone)
    return kSlimHang;
  return std::clamp(BesideBody(body, side).degrees(), kSlimHang, kMostHang);
}

}  // namespace mars::motion
