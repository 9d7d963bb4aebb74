// Ends a rendering before its last frame, from any thread, also from within a sink or a listener. The farm then takes
// no more strips, all nodes end, and render_film returns what there is.
#pragma once

#include <atomic>

namespace mars::farm {

class Cancellation {
 public:
  void cancel() { cancelled_ = true; }
  bool cancelled() const { return cancelled_; }

 private:
  std::atomic<bool> cancelled_ = false;
};

}  // namespace mars::farm
