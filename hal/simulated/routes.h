// When messages arrive: each part of a network that messages share (port, channel, link) passes one on at a time.
// Where messages hold all channels of their way at once they must be given in the order of their times; else in any.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "hal/simulated/calendar.h"
#include "hal/simulated/machine.h"

namespace mars::simulated {

class Routes {
 public:
  // Of `computers` computers, numbered from 0. `host`: the number of the host's computer; `computers` where that is
  // another one.
  Routes(const Network& network, int computers, int host);

  // When the last byte of a message arrives that `from` begins to send at `time`. Between two computers messages
  // arrive in the order in which they are given. No message will be given with a time before `floor`.
  double arrival(int from, int to, std::size_t bytes, double time, double floor);

  // Whether only an announcement goes at first, an empty message.
  bool announces(int from, int to, std::size_t bytes) const { return from != to && bytes > network_.eager; }
  // When the last byte arrives of an announced message that `to` answers at `time`: the answer, then the bytes. Where
  // these hold channels, others that are given until the answer comes wait behind them.
  double rest_arrival(int from, int to, std::size_t bytes, double time, double floor) {
    return arrival(from, to, bytes, arrival(to, from, 0, time, floor), floor);
  }

 private:
  struct Part {
    std::uint64_t name;
    double byte;  // seconds
  };

  void find_way(int from, int to);
  void add_cube_way(int from, int to);
  void add(std::uint64_t kind, std::uint64_t a, std::uint64_t b, double byte);
  double through_channels(std::size_t bytes, double time);
  double through_ports(std::size_t bytes, double time, double floor);

  const Network network_;
  const int computers_;
  const int host_;
  // Of parts that carried something: when they are busy; of channels, until when.
  std::unordered_map<std::uint64_t, Calendar> calendars_;
  std::unordered_map<std::uint64_t, double> busy_;
  std::unordered_map<std::uint64_t, double> last_;  // arrival, by sender and receiver
  std::vector<Part> way_;                           // of the message in hand
};

}  // namespace mars::simulated
