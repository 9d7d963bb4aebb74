#include "host/content/animator/motion/goals/grasp.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace mars::motion {
namespace {

constexpr double kTouch = 0.03;       // of a pad's radius: so near is a touch
constexpr double kLoose = 0.55;       // of the way, of fingers that find nothing to touch
constexpr double kLongestStep = 0.1;  // of the way from stretched to shut
constexpr int kMostSteps = 400;

// One finger on its way from stretched to closed; places are in the frame of the hand's end.
class Closing {
 public:
  Closing(const modeler::Model& model, const Digit& digit, std::size_t hand, const Posture& now, const Solid& thing)
      : model_(model), phalanges_(digit.phalanges), hand_(hand), now_(now), thing_(thing) {
    for (const Phalanx& phalanx : phalanges_) bends_.push_back(phalanx.open);
    is_still_.assign(phalanges_.size(), false);
    const std::vector<modeler::Axes> at = frames();
    for (std::size_t i = 0; i < phalanges_.size(); ++i)
      for (const Pad& pad : phalanges_[i].pads)
        if (thing_.holds(placed(at[i], pad.middle))) hold(i);
  }

  void close() {
    for (int step = 0; step < kMostSteps; ++step) {
      const double far = free_way();
      if (far <= 0) return;
      way_ += far;
      for (std::size_t i = 0; i < phalanges_.size(); ++i)
        if (!is_still_[i]) bends_[i] = std::min(phalanges_[i].shut, bends_[i] + far * range(i));
    }
  }

  void put(Fingers& fingers) const {
    for (std::size_t i = 0; i < phalanges_.size(); ++i) fingers[phalanges_[i].joint] = numbers(i, bends_[i]);
  }

 private:
  static glm::dvec3 placed(const modeler::Axes& frame, const glm::dvec3& at) { return frame.turn * at + frame.place; }
  double range(std::size_t i) const { return phalanges_[i].shut - phalanges_[i].open; }

  glm::dvec3 numbers(std::size_t i, double degrees) const {
    return bent(model_, phalanges_[i], degrees, now_.pose[phalanges_[i].joint]);
  }

  void hold(std::size_t last) {
    for (std::size_t i = 0; i <= last; ++i) is_still_[i] = true;
    touches_ = true;
  }

  std::vector<modeler::Axes> frames() const {
    std::vector<modeler::Axes> frames;
    for (std::size_t i = 0; i < phalanges_.size(); ++i) {
      const std::size_t above = i == 0 ? hand_ : phalanges_[i - 1].joint;
      modeler::Axes frame = i == 0 ? modeler::Axes{} : frames.back();
      // Joints between, that no finger is made of.
      std::vector<std::size_t> between;
      for (std::size_t joint = phalanges_[i].joint; joint != above; joint = model_.joints[joint].parent)
        between.push_back(joint);
      for (auto joint = between.rbegin(); joint != between.rend(); ++joint) {
        frame.place += frame.turn * model_.joints[*joint].place;
        const glm::dvec3 pose = *joint == phalanges_[i].joint ? numbers(i, bends_[i]) : now_.pose[*joint];
        frame.turn = frame.turn * modeler::orientation(model_.joints[*joint], pose);
      }
      frames.push_back(frame);
    }
    return frames;
  }

  // How far all that is not still may bend before anything can touch: a part of the way from stretched to shut. What
  // touches is still from then on, and what bends no further.
  double free_way() {
    const std::vector<modeler::Axes> at = frames();
    std::vector<std::pair<double, std::vector<double>>> gaps;  // of each pad the gap, and how fast each joint moves it
    for (std::size_t i = 0; i < phalanges_.size(); ++i)
      for (const Pad& pad : phalanges_[i].pads) {
        const glm::dvec3 middle = placed(at[i], pad.middle);
        const double gap = thing_.distance(middle) - pad.radius;
        if (gap <= kTouch * pad.radius) {
          hold(i);
          continue;
        }
        std::vector<double> speeds(phalanges_.size(), 0);
        for (std::size_t j = 0; j <= i; ++j) speeds[j] = glm::radians(range(j)) * glm::distance(middle, at[j].place);
        gaps.push_back({gap - 0.5 * kTouch * pad.radius, speeds});
      }
    double far = touches_ ? kLongestStep : std::min(kLongestStep, kLoose - way_);
    bool bends = false;
    for (std::size_t j = 0; j < phalanges_.size(); ++j) {
      if (bends_[j] >= phalanges_[j].shut) is_still_[j] = true;
      bends = bends || !is_still_[j];
    }
    for (const auto& [gap, speeds] : gaps) {
      double speed = 0;
      for (std::size_t j = 0; j < speeds.size(); ++j) speed += is_still_[j] ? 0 : speeds[j];
      if (speed > 0) far = std::min(far, gap / speed);
    }
    return bends ? far : 0;
  }

  const modeler::Model& model_;
  const std::vector<Phalanx>& phalanges_;
  std::size_t hand_;
  const Posture& now_;
  const Solid& thing_;
  std::vector<double> bends_;
  std::vector<bool> is_still_;
  bool touches_ = false;
  double way_ = 0;
};

}  // namespace

Fingers open_fingers(const modeler::Model& model, const std::vector<Digit>& digits, const Posture& now) {
  Fingers fingers;
  for (const Digit& digit : digits)
    for (const Phalanx& phalanx : digit.phalanges)
      fingers[phalanx.joint] = bent(model, phalanx, phalanx.open, now.pose[phalanx.joint]);
  return fingers;
}

Fingers closed_fingers(const modeler::Model& model, const std::vector<Digit>& digits, std::size_t hand,
                       const Posture& now, const Solid& thing) {
  Fingers fingers;
  for (const Digit& digit : digits) {
    Closing closing(model, digit, hand, now, thing);
    closing.close();
    closing.put(fingers);
  }
  return fingers;
}

Fingers relaxed_fingers(const modeler::Model& model, const std::vector<Digit>& digits) {
  Fingers fingers;
  for (const Digit& digit : digits)
    for (const Phalanx& phalanx : digit.phalanges) fingers[phalanx.joint] = model.joints[phalanx.joint].rest();
  return fingers;
}

void blend(const Fingers& from, const Fingers& to, double share, Posture& posture) {
  for (const auto& [joint, numbers] : to) posture.pose[joint] = glm::mix(from.at(joint), numbers, share);
}

Fingers fingers_in(const std::vector<Digit>& digits, const Posture& posture) {
  Fingers fingers;
  for (const Digit& digit : digits)
    for (const Phalanx& phalanx : digit.phalanges) fingers[phalanx.joint] = posture.pose[phalanx.joint];
  return fingers;
}

}  // namespace mars::motion
