// Plays exchanges of groups' nodes through (steps.h): messages wait for each other on the network, and take the
// processors of both ends.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "hal/simulated/computers.h"
#include "hal/simulated/routes.h"
#include "host/experiments/forecast/clockwork.h"
#include "host/experiments/forecast/costs.h"
#include "host/experiments/forecast/steps.h"

namespace mars::forecast {

class Exchanges {
 public:
  Exchanges(Clockwork& clockwork, simulated::Computers& computers, simulated::Routes& routes, const Costs& costs,
            int nodes)
      : clockwork_(clockwork),
        computers_(computers),
        routes_(routes),
        costs_(costs),
        nodes_(static_cast<std::size_t>(nodes)) {}
  Exchanges(auto&&, auto&&, auto&&, const Costs&&, auto&&...) = delete;

  // Node `n` of the group that begins at `first` takes these steps, then `then` happens. The steps outlive that.
  void begin(int n, int first, const Steps& steps, Clockwork::Action then);

  double bytes() const { return bytes_; }  // sent so far

 private:
  struct Message {
    int from;
    std::uint8_t label;
    std::uint32_t hops;  // how often it goes on
    double bytes;
    double seconds;    // of the receiver
    double there = 0;  // when it arrives
  };
  // A node sends one after the other.
  struct Outgoing {
    int to;
    Message message;
    bool passed_on;  // else a step of the node's own
  };
  // On their way to a node or there, in the order in which they arrive.
  class Coming {
   public:
    void add(const Message& message);
    // The first with the label; none: null.
    const Message* first(std::uint8_t label) const;
    Message take_first(std::uint8_t label);

   private:
    std::size_t place_of(std::uint8_t label) const;

    std::vector<Message> messages_;
    std::size_t begin_ = 0;  // those before were taken
  };
  struct Node {
    int first = 0;                 // of its group
    const Steps* steps = nullptr;  // none: it takes none
    std::size_t at = 0;
    std::uint32_t taken = 0;  // messages of the step
    bool waits = false;
    Clockwork::Action then;
    Coming coming;
    Outgoing outgoing{};
  };

  Node& of(int n) { return nodes_[static_cast<std::size_t>(n)]; }
  const Step& step_of(const Node& node) const { return (*node.steps)[node.at]; }
  void go_on(int n);
  void next_step(int n);
  void receive(int n);
  void wake(int n);
  void answer(int n, const Message& message);
  void take(int n, const Message& message);
  void pass_on(int n, const Message& message, double begin);
  double receiving(const Message& message) const;  // seconds
  void send(int n, const Outgoing& outgoing, double begin);
  void end_send(int n);
  void add_coming(int n, const Message& message);
  void work(int n, double seconds, void (Exchanges::*then)(int));
  void count_taken(int n);

  Clockwork& clockwork_;
  simulated::Computers& computers_;
  simulated::Routes& routes_;
  const Costs& costs_;
  std::vector<Node> nodes_;
  double bytes_ = 0;
};

}  // namespace mars::forecast
