// Short forms of what most bodies say to each other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace mars::conformance {

using Bytes = std::vector<unsigned char>;

bool is_host();
long next_node();  // round a ring of the nodes
long previous_node();

// `size` bytes that differ with `seed`.
Bytes pattern(std::size_t size, std::uint32_t seed);
long length_of(const Bytes& bytes);

void send_long(long type, long value, long to);
long receive_long(long typesel);

// An empty message of `type`.
void send_empty(long type, long to);
void receive_empty(long typesel);

// Lets seconds pass on the clocks, which may be simulated ones.
void let_pass(double seconds);

// Returns when all ranks have called it; in it, when each rank has come, it calls `between`.
void meet(const std::function<void()>& between);

}  // namespace mars::conformance
