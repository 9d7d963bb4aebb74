// A node's memory for one rendering, shared out before the film is sent.
#pragma once

#include <cstdint>
#include <optional>

#include "node/shadow/shadow_plan.h"
#include "node/wire/film_parts.h"
#include "node/wire/still_plan.h"

namespace mars::farm {

struct NodeMemory {
  std::uint64_t frames = 0;  // bytes for triangles and edge boxes
  // Bytes that it adds to what its machine keeps of stationary parts for inbetweens, where pixels have several samples
  // or lights cast shadows; else that is CZB alone and comes on top.
  std::uint64_t still = 0;
  wire::StillPlan still_plan{};  // of a node that is alone on its machine
  std::uint64_t shadows = 0;     // for drawing shadows (node/shadow/shadow_plan.h)
};

// Bytes of parts that are not shared out as usual.
struct AskedMemory {
  std::optional<std::uint64_t> still, shadows;
};

// Of `bytes`, what inbetweens need gets a quarter where pixels have several samples or lights cast shadows. Where
// these do, their shadows get a quarter too, but not less than they need, whatever `bytes` is, and not more than is of
// use. The rest is for frames, but where lights cast not more than an equal part of 1280 MiB for the `nodes` of a
// machine, and 128 MiB at least: several passes take little time beside shadows.
NodeMemory share_node_memory(std::uint64_t bytes, const AskedMemory& asked, const wire::FilmSettings& film,
                             const shadow::ShadowNeeds& shadows = {}, int nodes = 1);

// Throws Failure where a film's shadows need more than half of a node's `bytes`.
void check_shadow_memory(std::uint64_t bytes, const shadow::ShadowNeeds& shadows);

}  // namespace mars::farm
