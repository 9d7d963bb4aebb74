// The film on its way from the host: to the first of the nodes that lead a machine, and from each of them to two more.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace mars::node {

// Receives the film into `block`, and passes it on. `machines`: each node's, as in Load; the caller leads its own.
void receive_film(std::span<std::byte> block, std::span<const std::int32_t> machines);

}  // namespace mars::node
