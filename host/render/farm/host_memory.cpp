#include "host/render/farm/host_memory.h"

#include <algorithm>

#include "node/wire/protocol.h"

namespace mars::farm {
namespace {

constexpr std::uint64_t kOftenEnough = std::uint64_t{1} << 30;
constexpr std::uint32_t kLeastFrames = 2;  // one is composed while the other is written

}  // namespace

std::uint64_t HostMemory::strip_bytes() const {
  return std::uint64_t{nodes} * static_cast<std::uint64_t>(credits) * wire::max_strip_bytes(format);
}

std::uint64_t HostMemory::most_bytes() const {
  return (std::uint64_t{frames} + backgrounds) * frame_bytes + strip_bytes();
}

HostMemory share_host_memory(std::uint64_t budget, const wire::FilmSettings& film, wire::PixelFormat format,
                             std::uint32_t nodes, std::uint32_t groups, std::uint32_t sink_threads) {
  HostMemory memory;
  memory.budget = budget;
  memory.format = format;
  memory.frame_bytes = std::uint64_t{film.width} * film.height * wire::pixel_bytes(format);
  memory.frames = kLeastFrames;
  memory.backgrounds = groups + memory.frames;
  memory.nodes = nodes;
  memory.credits = wire::kMaxCredits;
  while (memory.credits > 1 && memory.most_bytes() > budget) --memory.credits;
  const std::uint64_t left = budget - std::min(budget, memory.most_bytes());
  const std::uint64_t often_enough = std::max(kOftenEnough, budget / 8) / memory.frame_bytes;
  const std::uint64_t fit = std::min(often_enough, kLeastFrames + left / (2 * memory.frame_bytes));
  memory.frames = static_cast<std::uint32_t>(std::clamp<std::uint64_t>(fit, kLeastFrames, sink_threads + 2));
  memory.backgrounds = groups + memory.frames;
  return memory;
}

HostMemory where_nodes_write(HostMemory shared) {
  shared.frames = 1;
  shared.backgrounds = shared.nodes = 0;
  return shared;
}

}  // namespace mars::farm
