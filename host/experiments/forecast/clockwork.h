// A run that is played through by counted time: what happens, in the order of its times.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace mars::forecast {

class Clockwork {
 public:
  using Action = std::function<void()>;

  double now() const { return now_; }
  // Actions of one time happen in the order in which they were given.
  void at(double time, Action action);
  // Until nothing is left to happen, or until that time; whether nothing is left.
  bool run(double until);

 private:
  struct Event {
    double time;
    std::uint64_t number;
    std::size_t action;  // in actions_

    bool operator<(const Event& other) const {
      return time != other.time ? time > other.time : number > other.number;  // a heap's top is the greatest
    }
  };

  std::vector<Event> events_;      // a heap
  std::vector<Action> actions_;    // apart, as the heap moves its items often
  std::vector<std::size_t> free_;  // places in actions_
  std::uint64_t events_given_ = 0;
  double now_ = 0;
};

}  // namespace mars::forecast
