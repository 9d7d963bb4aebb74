#include "host/studio/web/link_speed.h"

#include <algorithm>

namespace mars::web {
namespace {

constexpr double kNoticed = 0.02;   // seconds; a screen's refresh and a busy page are within
constexpr double kRawAbove = 30e6;  // bytes a second; deflating takes longer than it saves
constexpr double kLossyBelow = 10e6;
constexpr double kBelievable = 16;   // times the speed that an acknowledgement within kNoticed proves
constexpr double kInflating = 0.01;  // seconds; a page does it in several steps, each waits for its turn
constexpr double kFewBytes = 4096, kManyBytes = 32768;

}  // namespace

void LinkSpeed::acknowledged(std::size_t bytes, double seconds) {
  shortest_ = std::min(shortest_, seconds);
  const double sent = static_cast<double>(bytes), link = seconds - shortest_;
  if (link > kNoticed) {
    speed_ = (speed_ + 3 * sent / link) / 4;
  } else {
    speed_ = std::max(speed_, std::min(2 * speed_, kBelievable * sent / kNoticed));
  }
}

Encoding LinkSpeed::best_for(std::size_t pixel_bytes, bool lossy) const {
  const double not_worth_it = std::clamp(speed_ * kInflating, kFewBytes, kManyBytes);
  if (static_cast<double>(pixel_bytes) <= not_worth_it || speed_ > kRawAbove) return Encoding::raw;
  return lossy && speed_ < kLossyBelow ? Encoding::jpeg : Encoding::deflate;
}

}  // namespace mars::web
