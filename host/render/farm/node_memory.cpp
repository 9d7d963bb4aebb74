#include "host/render/farm/node_memory.h"

#include <algorithm>

namespace mars::farm {

NodeMemory share_node_memory(std::uint64_t bytes, std::optional<std::uint64_t> still, const wire::FilmSettings& film,
                             std::uint32_t casting) {
  constexpr std::uint64_t kStillPart = 4;
  NodeMemory memory;
  if (film.samples > 1 || casting > 0) memory.still = std::min(still.value_or(bytes / kStillPart), bytes);
  memory.frames = bytes - memory.still;
  memory.still_plan = wire::plan_still_lines(film.width, film.height, film.samples, memory.still, casting);
  return memory;
}

}  // namespace mars::farm
