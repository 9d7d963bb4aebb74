// Waits for what must come, as long as a busy machine may need.
#pragma once

#include <chrono>
#include <thread>

namespace mars::test {

template <typename Holds>
bool comes(const Holds& holds) {
  const auto last = std::chrono::steady_clock::now() + std::chrono::seconds(200);
  while (!holds()) {
    if (std::chrono::steady_clock::now() > last) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

}  // namespace mars::test
