// The host's commands as they arrived, checked before anything of them is used: sizes against counts, counts and ranges
// against the film and the node's group; and what is common to checks of other nodes' messages. What does not fit is a
// Failure. What is returned lies within the message.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "node/wire/film.h"
#include "node/wire/protocol.h"

namespace mars::wire {

struct LoadCommand {
  const Load& load;
  std::span<const std::int32_t> machines;  // each node's
};

struct RenderCommand {
  const Render& render;
  std::span<const std::uint32_t> frames;  // in the message, or in `frames` of read_render
};

// For one of `nodes` nodes; `receiver` names it in a failure: "n3 (node 17)".
LoadCommand read_load(std::span<const std::byte> message, int nodes, const std::string& receiver);

// Of Load's machines, for node `node`, which shares memory with `count` nodes, itself among them, that are on
// `machine`.
void check_machines(std::span<const std::int32_t> machines, int node, int machine, int count);

// For node `node` of `nodes`, which form `groups` groups. Frames that are not listed are put into `frames`.
RenderCommand read_render(std::span<const std::byte> message, const FilmView& film, int node, int nodes, int groups,
                          std::vector<std::uint32_t>& frames);

// For a node that has the slots of `owned`, a bit for each, of `slots` in all.
const Credit& read_credit(std::span<const std::byte> message, std::uint32_t owned, std::size_t slots);

// For what node `sender` sent, "triangles".
void require_sense(bool holds, int sender, const char* what);

// For commands of a fixed size, such as Stop and Clock, which are empty.
void check_size(const char* command, std::size_t bytes, std::size_t expected);

}  // namespace mars::wire
