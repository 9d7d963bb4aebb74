// When messages arrive: each part of a network that messages share (port, channel, link) is a queue that is busy until
// some time. Messages are given in the order of their times.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "hal/simulated/machine.h"

namespace mars::simulated {

class Routes {
 public:
  // Of `computers`; the host's has the number `host`, which is one of these, or `computers` where it is apart.
  Routes(const Network& network, int computers, int host);

  // When the last byte of a message arrives that `from` begins to send at `time`. Between two computers messages
  // arrive in the order in which they are given.
  double arrival(int from, int to, std::size_t bytes, double time);

 private:
  struct Part {
    std::uint64_t name;
    double byte;  // seconds
  };

  void find_way(int from, int to);
  void add_cube_way(int from, int to);
  void add(std::uint64_t kind, std::uint64_t a, std::uint64_t b, double byte);
  double through_channels(std::size_t bytes, double time);
  double through_queues(std::size_t bytes, double time);

  const Network network_;
  const int computers_;
  const int host_;
  std::unordered_map<std::uint64_t, double> busy_;  // until; parts that carried something
  std::vector<Part> way_;                           // of the message in hand
};

}  // namespace mars::simulated
