#include "host/render/farm/node_memory.h"

#include <algorithm>
#include <string>

#include "hal/failure/failure.h"

namespace mars::farm {
namespace {

constexpr std::uint64_t kPart = 4;  // of the memory: a quarter

std::uint64_t shadow_bytes(std::uint64_t bytes, const shadow::ShadowNeeds& shadows) {
  return shadow::plan_shadows(shadows, bytes).bytes();
}

std::uint64_t frames_with_shadows(int nodes) {
  constexpr std::uint64_t kMachine = std::uint64_t{1280} << 20, kLeast = std::uint64_t{128} << 20;
  return std::max(kMachine / static_cast<std::uint64_t>(nodes), kLeast);
}

std::string mebibytes(std::uint64_t bytes) { return std::to_string((bytes + (1 << 20) - 1) >> 20) + " MiB"; }

}  // namespace

NodeMemory share_node_memory(std::uint64_t bytes, const AskedMemory& asked, const wire::FilmSettings& film,
                             const shadow::ShadowNeeds& shadows, int nodes) {
  NodeMemory memory;
  memory.shadows = shadow_bytes(asked.shadows.value_or(bytes / kPart), shadows);
  const std::uint64_t rest = bytes - std::min(bytes, memory.shadows);
  if (film.samples > 1 || shadows.casting > 0)
    memory.still = std::min(asked.still.value_or(std::min(bytes / kPart, rest / 2)), rest);
  memory.frames = rest - memory.still;
  if (shadows.casting > 0) memory.frames = std::min(memory.frames, frames_with_shadows(nodes));
  memory.still_plan =
      wire::plan_still_lines(film.width, film.height, film.samples, memory.still, shadows.casting, shadows.has_layers);
  return memory;
}

void check_shadow_memory(std::uint64_t bytes, const shadow::ShadowNeeds& shadows) {
  const std::uint64_t least = shadow::least_shadow_bytes(shadows);
  if (least <= bytes / 2) return;
  throw Failure("shadows of this film need " + mebibytes(least) + ", which is more than half of the " +
                    mebibytes(bytes) + " of a node",
                "memory",
                "set MARS_MEMORY to " + std::to_string((2 * least >> 20) + 1) +
                    " or more, start fewer nodes a machine, or render a smaller picture or fewer samples");
}

}  // namespace mars::farm
