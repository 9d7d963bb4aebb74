#include "host/experiments/forecast/exchanges.h"

#include <utility>

namespace mars::forecast {

void Exchanges::begin(int n, int first, const Steps& steps, Clockwork::Action then) {
  Node& node = of(n);
  node.first = first;
  node.steps = &steps;
  node.at = node.taken = 0;
  node.then = std::move(then);
  go_on(n);
}

void Exchanges::go_on(int n) {
  Node& node = of(n);
  if (node.at == node.steps->size()) return std::exchange(node.then, {})();
  const Step& step = step_of(node);
  switch (step.kind) {
    case Step::Kind::work: return work(n, step.seconds, &Exchanges::next_step);
    case Step::Kind::send:
      return send(n, node.first + step.node, {n, step.label, step.count, step.bytes, step.seconds},
                  &Exchanges::next_step);
    case Step::Kind::receive: return receive(n);
  }
}

void Exchanges::next_step(int n) {
  ++of(n).at;
  go_on(n);
}

void Exchanges::receive(int n) {
  Node& node = of(n);
  const Step& step = step_of(node);
  if (node.taken == step.count) {
    node.taken = 0;
    return next_step(n);
  }
  std::deque<Message>& arrived = node.arrived[step.label];
  if (arrived.empty()) {
    node.waits = true;
    return;
  }
  const Message message = arrived.front();
  arrived.pop_front();
  answer(n, message);
}

// The rest of an announced message comes once it is answered.
void Exchanges::answer(int n, const Message& message) {
  const int from = computers_.of(message.from), to = computers_.of(n);
  const auto length = static_cast<std::size_t>(message.bytes);
  const double now = clockwork_.now();
  const bool takes_time = costs_.takes_time(message_type(message.label));
  if (!takes_time || !routes_.announces(from, to, length)) return take(n, message);
  clockwork_.at(routes_.rest_arrival(from, to, length, now, now), [this, n, message] { take(n, message); });
}

// It goes on before the next is taken.
void Exchanges::take(int n, const Message& message) {
  const double end = computers_.work(n, clockwork_.now(), receiving(message) + message.seconds);
  if (message.hops == 0) return clockwork_.at(end, [this, n] { count_taken(n); });
  clockwork_.at(end, [this, n, message] {
    const Node& node = of(n);
    Message next = message;
    next.from = n;
    --next.hops;
    send(n, node.first + step_of(node).node, next, &Exchanges::count_taken);
  });
}

double Exchanges::receiving(const Message& message) const {
  return costs_.takes_time(message_type(message.label)) ? costs_.to_receive(message.bytes) : 0;
}

void Exchanges::count_taken(int n) {
  ++of(n).taken;
  receive(n);
}

void Exchanges::send(int n, int to, const Message& message, void (Exchanges::*then)(int)) {
  bytes_ += message.bytes;
  const bool takes_time = costs_.takes_time(message_type(message.label));
  const double sending = takes_time ? costs_.to_send(message.bytes) : 0;
  clockwork_.at(computers_.work(n, clockwork_.now(), sending), [this, n, to, message, then, takes_time] {
    const double now = clockwork_.now();
    const int here = computers_.of(n), there = computers_.of(to);
    const auto length = static_cast<std::size_t>(message.bytes);
    const bool announced = takes_time && routes_.announces(here, there, length);
    const double arrival = takes_time ? routes_.arrival(here, there, announced ? 0 : length, now, now) : now;
    clockwork_.at(arrival, [this, to, message] { arrive(to, message); });
    (this->*then)(n);
  });
}

void Exchanges::arrive(int n, const Message& message) {
  Node& node = of(n);
  node.arrived[message.label].push_back(message);
  if (!node.waits || step_of(node).label != message.label) return;
  node.waits = false;
  receive(n);
}

void Exchanges::work(int n, double seconds, void (Exchanges::*then)(int)) {
  clockwork_.at(computers_.work(n, clockwork_.now(), seconds), [this, n, then] { (this->*then)(n); });
}

}  // namespace mars::forecast
