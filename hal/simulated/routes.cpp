#include "hal/simulated/routes.h"

#include <algorithm>
#include <bit>

namespace mars::simulated {
namespace {

enum Kind : std::uint64_t { kMemory, kOut, kIn, kUp, kDown, kPair, kChannel, kHostLink };

}  // namespace

Routes::Routes(const Network& network, int computers, int host)
    : network_(network), computers_(computers), host_(host) {}

double Routes::arrival(int from, int to, std::size_t bytes, double time, double floor) {
  way_.clear();
  double latency = network_.local_latency;
  if (from == to) {
    add(kMemory, static_cast<std::uint64_t>(from), 0, network_.local_byte);
  } else {
    find_way(from, to);
    const bool with_host = host_ == computers_ && (from == host_ || to == host_);
    latency =
        network_.latency + network_.hop * static_cast<double>(way_.size()) + (with_host ? network_.host_latency : 0);
  }
  const bool circuit = network_.topology == Topology::hypercube && from != to;
  const double end = circuit ? through_channels(bytes, time) : through_ports(bytes, time, floor);
  double& last = last_[static_cast<std::uint64_t>(from) << 32 | static_cast<std::uint64_t>(to)];
  return last = std::max(last, end + latency);
}

void Routes::add(std::uint64_t kind, std::uint64_t a, std::uint64_t b, double byte) {
  way_.push_back({kind << 60 | a << 30 | b, byte});
}

void Routes::find_way(int from, int to) {
  if (network_.topology == Topology::hypercube) return add_cube_way(from, to);
  const auto a = static_cast<std::uint64_t>(from), b = static_cast<std::uint64_t>(to);
  const auto port = [&](int computer) {
    return computer == host_ && host_ == computers_ && network_.host_byte > 0 ? network_.host_byte : network_.byte;
  };
  add(kOut, a, 0, port(from));
  if (network_.topology != Topology::one_switch) {
    const std::uint64_t leaf = static_cast<std::uint64_t>(network_.leaf), leaf_a = a / leaf, leaf_b = b / leaf;
    if (leaf_a != leaf_b && network_.topology == Topology::fat_tree) {
      add(kUp, leaf_a, 0, network_.uplink);
      add(kDown, leaf_b, 0, network_.uplink);
    } else if (leaf_a != leaf_b) {
      add(kPair, leaf_a, leaf_b, network_.uplink);
    }
  }
  add(kIn, b, 0, port(to));
}

// The lowest differing bit first. The host is beside computer 0.
void Routes::add_cube_way(int from, int to) {
  if (from == host_ && host_ == computers_) add(kHostLink, 0, 0, network_.host_byte), from = 0;
  const bool to_host = to == host_ && host_ == computers_;
  const int end = to_host ? 0 : to;
  for (int at = from; at != end;) {
    const int bit = std::countr_zero(static_cast<unsigned>(at ^ end));
    add(kChannel, static_cast<std::uint64_t>(at), static_cast<std::uint64_t>(bit), network_.byte);
    at ^= 1 << bit;
  }
  if (to_host) add(kHostLink, 1, 0, network_.host_byte);
}

// All parts at once, at the rate of the slowest.
double Routes::through_channels(std::size_t bytes, double time) {
  double slowest = 0;
  for (const Part& part : way_) {
    time = std::max(time, busy_[part.name]);
    slowest = std::max(slowest, part.byte);
  }
  const double end = time + slowest * static_cast<double>(bytes);
  for (const Part& part : way_) busy_[part.name] = end;
  return end;
}

// One part after the other; a part passes bytes on while more of them come.
double Routes::through_ports(std::size_t bytes, double time, double floor) {
  double end = time;
  for (const Part& part : way_) {
    const double seconds = part.byte * static_cast<double>(bytes);
    time = calendars_[part.name].book(time, seconds, floor);
    end = std::max(end, time + seconds);
  }
  return end;
}

}  // namespace mars::simulated
