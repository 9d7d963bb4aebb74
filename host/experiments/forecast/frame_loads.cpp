#include "host/experiments/forecast/frame_loads.h"

namespace mars::forecast {

std::shared_ptr<const KeyframeLoad> KeyframeLoads::of(const Key& key, const std::function<KeyframeLoad()>& make) {
  Entry& entry = [&]() -> Entry& {
    const std::scoped_lock lock(mutex_);
    return entries_[key];
  }();
  std::call_once(entry.once, [&] { entry.load = std::make_shared<const KeyframeLoad>(make()); });
  return entry.load;
}

}  // namespace mars::forecast
