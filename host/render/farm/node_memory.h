// A node's memory for one rendering, shared out before the film is sent.
#pragma once

#include <cstdint>
#include <optional>

#include "node/wire/film_parts.h"
#include "node/wire/still_plan.h"

namespace mars::farm {

struct NodeMemory {
  std::uint64_t frames = 0;  // bytes for triangles and edge boxes
  // Bytes that it adds to what its machine keeps of stationary parts for inbetweens, where pixels have several samples
  // or lights cast shadows; else that is CZB alone and comes on top.
  std::uint64_t still = 0;
  wire::StillPlan still_plan{};  // of a node that is alone on its machine
};

// Of `bytes`, what inbetweens need gets `still`, or a quarter, where pixels have several samples
// or `casting` lights cast shadows.
NodeMemory share_node_memory(std::uint64_t bytes, std::optional<std::uint64_t> still, const wire::FilmSettings& film,
                             std::uint32_t casting = 0);

}  // namespace mars::farm
