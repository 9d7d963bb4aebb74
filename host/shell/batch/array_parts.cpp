#include "host/shell/batch/array_parts.h"

#include <cstdint>

namespace mars::batch {

// Each task goes to the part in which its middle lies, were all frames divided equally.
std::vector<film::FrameSet> array_parts(std::span<const farm::Task> tasks, std::size_t count) {
  std::size_t all = 0, before = 0;
  for (const farm::Task& task : tasks) all += task.frames.size();
  std::vector<std::vector<std::uint32_t>> frames(count);
  for (const farm::Task& task : tasks) {
    std::vector<std::uint32_t>& part = frames[(2 * before + task.frames.size()) * count / (2 * all)];
    part.insert(part.end(), task.frames.begin(), task.frames.end());
    before += task.frames.size();
  }
  std::vector<film::FrameSet> parts;
  for (const std::vector<std::uint32_t>& part : frames)
    if (!part.empty()) parts.emplace_back(std::span<const std::uint32_t>(part));
  return parts;
}

}  // namespace mars::batch
