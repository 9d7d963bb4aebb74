#include "host/experiments/forecast/side_by_side.h"

#include <atomic>
#include <future>
#include <vector>

namespace mars::forecast {

void side_by_side(std::size_t count, int threads, const std::function<void(std::size_t)>& action) {
  std::atomic<std::size_t> next = 0;
  const auto take_turns = [&] {
    for (std::size_t number = next++; number < count; number = next++) action(number);
  };
  std::vector<std::future<void>> others;
  for (int other = 1; other < threads && static_cast<std::size_t>(other) < count; ++other)
    others.push_back(std::async(std::launch::async, take_turns));
  take_turns();
  for (std::future<void>& other : others) other.get();
}

}  // namespace mars::forecast
