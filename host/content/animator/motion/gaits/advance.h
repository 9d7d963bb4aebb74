// How far a figure has gone along its way that sets out, keeps a speed and stops.
#pragma once

#include <algorithm>

namespace mars::motion {

class Advance {
 public:
  // All frames; setting out takes at most `sets_out` of them, stopping `stops`.
  Advance(double length, double begin, double end, double sets_out, double stops)
      : begin_(begin),
        end_(end),
        share_(std::min(1.0, (end - begin) / (sets_out + stops))),
        sets_out_(sets_out * share_),
        stops_(stops * share_),
        speed_(length / (end - begin - (sets_out_ + stops_) / 2)),
        length_(length) {}

  double at(double time) const {
    if (time <= begin_) return 0;
    if (time >= end_) return length_;
    if (time < begin_ + sets_out_) return speed_ * sets_out_ * ramp((time - begin_) / sets_out_);
    if (time > end_ - stops_) return length_ - speed_ * stops_ * ramp((end_ - time) / stops_);
    return speed_ * (time - begin_ - sets_out_ / 2);
  }

  double speed_at(double time) const { return (at(time + kMoment) - at(time - kMoment)) / (2 * kMoment); }
  double speed() const { return speed_; }  // that it keeps

 private:
  static constexpr double kMoment = 1e-3;  // frames

  // The way at a speed that rises from 0 to 1 by (3 - 2 u) u^2.
  static double ramp(double u) { return (1 - u / 2) * u * u * u; }

  double begin_, end_, share_, sets_out_, stops_, speed_, length_;
};

}  // namespace mars::motion
