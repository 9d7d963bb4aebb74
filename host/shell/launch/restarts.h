// How often a job is started again: any number of times while frames come, a few times where none does.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

namespace mars::launch {

class Restarts {
 public:
  explicit Restarts(std::uint32_t most) : most_(most) {}

  // After a job that died: how long to wait before the next one, longer each time that no frame came; none: there were
  // enough.
  std::optional<std::chrono::seconds> again(bool new_frames);

  std::uint32_t number() const { return number_; }  // of restarts since a frame came
  std::uint32_t most() const { return most_; }
  std::uint32_t all() const { return all_; }

 private:
  std::uint32_t most_;
  std::uint32_t number_ = 0;
  std::uint32_t all_ = 0;
};

}  // namespace mars::launch
