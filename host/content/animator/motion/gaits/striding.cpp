#include "host/content/animator/motion/gaits/striding.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "hal/failure/failure.h"
#include "host/content/animator/motion/gaits/four_legs.h"
#include "host/content/animator/motion/body/glide.h"

namespace mars::motion {
namespace {

constexpr double kFirstStrideTurn = 12;      // degrees that the first stride can turn
constexpr double kTurnAStride = 30;          // degrees a stride
constexpr double kLeastTurnOfStrides = 0.2;  // degrees

// What the parameters are called that count: a walk's steps are half strides.
struct Counted {
  std::string_view count, length;
  int in_a_stride;
};
constexpr Counted kCountedSteps{"steps", "step-length", 2}, kCountedStrides{"strides", "stride-length", 1};

class Striding {
 public:
  Striding(const Scene& scene, const FourLegGait& gait, const Counted& counted)
      : scene_(scene),
        gait_(gait),
        counted_(counted),
        body_(body_of(scene.model(), scene.actor.name, std::string(scene.action))),
        period_(std::max(8.0, std::round(counted.in_a_stride * scene.film.rate /
                                         scene.arguments.number("pace", gait.pace * counted.in_a_stride, {0.1, 10})))) {
    if (!body_.forelegs)
      throw Failure("has no four legs, which '" + std::string(scene.action) + "' needs",
                    "actor '" + scene.actor.name + "'",
                    "let it walk or run, or name its forelegs in its model's limbs: docs/model-format.md");
    postures_.push_back(posture_of(scene));
    require_upright(scene, body_, postures_[0]);
  }

  Stand stand() const {
    const Posture& posture = postures_.back();
    const auto place = [&](std::size_t joint) { return glm::dvec2(frame_in(*body_.model, posture, joint).place); };
    glm::dvec2 sum(0);
    for (const auto& legs : {body_.legs, *body_.forelegs})
      for (const Leg& leg : legs) sum += place(leg.hip);
    return {sum / 4.0, body_.heading_of(posture)};
  }

  void turn(double by) {
    const int strides = std::max(1, int(std::ceil(std::abs(by) / kTurnAStride)));
    go(four_leg_walk(), {{stand(), 0, 0}, by, strides});
  }

  // Turns first where `to` asks for it.
  void go_as_asked() {
    const Arguments& arguments = scene_.arguments;
    refuse_contradictions(arguments, counted_.count, counted_.length);
    const std::uint32_t asked = arguments.count(counted_.count, 4 * std::uint32_t(counted_.in_a_stride), kMostSteps);
    std::optional<double> far = arguments.number("distance", {1e-6, document::kFarthest});
    const auto to = arguments.vector("to");
    if (to) {
      const double by = bearing(stand(), *to);
      if (std::abs(by) > kFirstStrideTurn) turn(by);
      far = glm::distance(stand().middle, glm::dvec2(to->x, to->y));
      if (*far < 0.05 * body_.height) return;
    }
    const double ordinary = gait_.stride * body_.height / counted_.in_a_stride;
    const double length = arguments.number(counted_.length, ordinary, {1e-6, document::kFarthest});
    const double stride = length * counted_.in_a_stride;
    const double lost = lost_strides(gait_);
    const int strides = far && !arguments.has(counted_.count)
                            ? int(count_for(arguments, *far / stride + lost, *far, stride))
                            : std::max(1, int(asked) / counted_.in_a_stride);
    Path path{stand(), far ? *far : std::max(0.4, strides - lost) * stride, arguments.number("turn", 0, {-3600, 3600})};
    if (to) path.start.heading += bearing(path.start, *to);
    go(gait_, {path, 0, strides});
  }

  Motion motion() const {
    return {keys_of(body_, body_.joints(), postures_, scene_.at), scene_.at + std::uint32_t(postures_.size()) - 1, ""};
  }

 private:
  static double count_for(const Arguments& arguments, double strides, double far, double stride) {
    if (strides > kMostSteps)
      arguments.refuse(arguments.has("to") ? "to" : "distance",
                       "is " + document::shown(far) + " away, which takes more than " + std::to_string(kMostSteps) +
                           " strides of " + document::shown(stride),
                       "go to a nearer place");
    return std::max(1.0, std::round(strides));
  }

  void go(const FourLegGait& gait, const Errand& errand) {
    const Arguments& arguments = scene_.arguments;
    scene_.last_after(double(postures_.size() - 1) + four_leg_frames(gait, errand.strides, period_));
    const FourLegStyle style{arguments.number("bounce", 1, {0, 3}), arguments.number("knee-lift", 1, {0, 3})};
    const Posture start = postures_.back();
    std::vector<Posture> more =
        four_leg_postures(body_, start, gait, style, errand, period_, scene_.at + std::uint32_t(postures_.size()) - 1,
                          std::string(scene_.action));
    begin_at(*body_.model, start, 0.1 * period_, more);
    postures_.insert(postures_.end(), more.begin() + 1, more.end());
  }

  const Scene& scene_;
  const FourLegGait& gait_;
  const Counted& counted_;
  Body body_;
  double period_;  // frames of a stride
  std::vector<Posture> postures_;
};

Motion gone(const Scene& scene, const FourLegGait& gait, const Counted& counted) {
  Striding striding(scene, gait, counted);
  striding.go_as_asked();
  return striding.motion();
}

}  // namespace

Motion walk_on_four(const Scene& scene) { return gone(scene, four_leg_walk(), kCountedSteps); }
Motion trot(const Scene& scene) { return gone(scene, four_leg_trot(), kCountedStrides); }
Motion gallop(const Scene& scene) { return gone(scene, four_leg_gallop(), kCountedStrides); }

Motion turn_on_four(const Scene& scene) {
  refuse_both(scene.arguments, "by", "to");
  Striding striding(scene, four_leg_walk(), kCountedSteps);
  const auto to = scene.arguments.vector("to");
  const double by = to ? bearing(striding.stand(), *to) : scene.arguments.number("by", 90, {-3600, 3600});
  if (std::abs(by) > kLeastTurnOfStrides) striding.turn(by);
  return striding.motion();
}

}  // namespace mars::motion
