#include "host/experiments/forecast/exchanges.h"

#include <algorithm>
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
      return send(n, {node.first + step.node, {n, step.label, step.count, step.bytes, step.seconds}, false},
                  clockwork_.now());
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
  const Message* first = node.coming.first(step.label);
  if (first != nullptr && first->there <= clockwork_.now()) return answer(n, node.coming.take_first(step.label));
  node.waits = true;
  if (first != nullptr) clockwork_.at(first->there, [this, n] { wake(n); });
}

// Of a node that may have gone on meanwhile, or for which another message arrives earlier.
void Exchanges::wake(int n) {
  Node& node = of(n);
  if (!node.waits) return;
  const Message* first = node.coming.first(step_of(node).label);
  if (first == nullptr || first->there > clockwork_.now()) return;
  node.waits = false;
  receive(n);
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

// It goes on before the next is taken. What a node does on a processor of its own is known as soon as it begins.
void Exchanges::take(int n, const Message& message) {
  const double end = computers_.work(n, clockwork_.now(), receiving(message) + message.seconds);
  if (message.hops == 0) return clockwork_.at(end, [this, n] { count_taken(n); });
  if (!computers_.crowded(computers_.of(n))) return pass_on(n, message, end);
  clockwork_.at(end, [this, n, message] { pass_on(n, message, clockwork_.now()); });
}

void Exchanges::pass_on(int n, const Message& message, double begin) {
  const Node& node = of(n);
  Message next = message;
  next.from = n;
  --next.hops;
  send(n, {node.first + step_of(node).node, next, true}, begin);
}

double Exchanges::receiving(const Message& message) const {
  return costs_.takes_time(message_type(message.label)) ? costs_.to_receive(message.bytes) : 0;
}

void Exchanges::count_taken(int n) {
  ++of(n).taken;
  receive(n);
}

void Exchanges::send(int n, const Outgoing& outgoing, double begin) {
  const double bytes = outgoing.message.bytes;
  bytes_ += bytes;
  of(n).outgoing = outgoing;
  const bool takes_time = costs_.takes_time(message_type(outgoing.message.label));
  const double sent = computers_.work(n, begin, takes_time ? costs_.to_send(bytes) : 0);
  clockwork_.at(sent, [this, n] { end_send(n); });
}

void Exchanges::end_send(int n) {
  const double now = clockwork_.now();
  Outgoing& outgoing = of(n).outgoing;
  Message& message = outgoing.message;
  const int here = computers_.of(n), there = computers_.of(outgoing.to);
  const auto length = static_cast<std::size_t>(message.bytes);
  const bool takes_time = costs_.takes_time(message_type(message.label));
  const bool announced = takes_time && routes_.announces(here, there, length);
  message.there = takes_time ? routes_.arrival(here, there, announced ? 0 : length, now, now) : now;
  add_coming(outgoing.to, message);
  outgoing.passed_on ? count_taken(n) : next_step(n);
}

void Exchanges::add_coming(int n, const Message& message) {
  Node& node = of(n);
  node.coming.add(message);
  if (!node.waits || step_of(node).label != message.label) return;
  if (node.coming.first(message.label)->there == message.there) clockwork_.at(message.there, [this, n] { wake(n); });
}

void Exchanges::Coming::add(const Message& message) {
  const auto begin = messages_.begin() + static_cast<std::ptrdiff_t>(begin_);
  messages_.insert(std::upper_bound(begin, messages_.end(), message.there,
                                    [](double there, const Message& other) { return there < other.there; }),
                   message);
}

std::size_t Exchanges::Coming::place_of(std::uint8_t label) const {
  std::size_t place = begin_;
  while (place < messages_.size() && messages_[place].label != label) ++place;
  return place;
}

auto Exchanges::Coming::first(std::uint8_t label) const -> const Message* {
  const std::size_t place = place_of(label);
  return place < messages_.size() ? &messages_[place] : nullptr;
}

auto Exchanges::Coming::take_first(std::uint8_t label) -> Message {
  const std::size_t place = place_of(label);
  const Message taken = messages_[place];
  if (place > begin_)
    messages_.erase(messages_.begin() + static_cast<std::ptrdiff_t>(place));
  else if (2 * ++begin_ >= messages_.size())
    messages_.erase(messages_.begin(), messages_.begin() + static_cast<std::ptrdiff_t>(std::exchange(begin_, 0)));
  return taken;
}

void Exchanges::work(int n, double seconds, void (Exchanges::*then)(int)) {
  clockwork_.at(computers_.work(n, clockwork_.now(), seconds), [this, n, then] { (this->*then)(n); });
}

}  // namespace mars::forecast
