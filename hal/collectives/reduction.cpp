#include "hal/collectives/reduction.h"

#include "hal/messages/process.h"

namespace mars::collectives {
namespace {

// Bytes from which on sharing the work is worth twice the messages: docs/messages.md has the measurements.
constexpr std::size_t kShared = 64 * 1024;

struct Vectors {
  const Operation& operation;
  std::byte* x;
  std::byte* work;

  std::byte* mine(std::size_t at) const { return x + at * operation.element; }
  std::byte* theirs(std::size_t at) const { return work + at * operation.element; }
  std::size_t bytes(std::size_t n) const { return n * operation.element; }
  void merge(std::size_t first, std::size_t n, bool mine_first) const {
    if (n > 0) operation.merge(operation, mine(first), theirs(first), n, mine_first);
  }
};

// Whole vectors across each bit.
void double_up(DimensionExchange& exchange, const Vectors& vectors, std::size_t n) {
  const int me = exchange.position();
  for (int bit = 1; bit < exchange.corners(); bit <<= 1) {
    exchange.swap_with(me ^ bit, vectors.x, vectors.bytes(n), vectors.work, vectors.bytes(n));
    if (!exchange.spoilt()) vectors.merge(0, n, (me & bit) == 0);
  }
}

// Elements [first, last).
struct Part {
  std::size_t first;
  std::size_t last;

  std::size_t size() const { return last - first; }
  Part half(bool upper) const {
    const std::size_t middle = first + size() / 2;
    return upper ? Part{middle, last} : Part{first, middle};
  }
};

// Halves across each bit, so that each corner has one part of the result; and back, so that all have all.
void halve_and_double(DimensionExchange& exchange, const Vectors& vectors, std::size_t n) {
  const int me = exchange.position();
  Part whole[32];  // of which a step leaves a half, by step
  whole[0] = {0, n};
  int step = 0;
  for (int bit = 1; bit < exchange.corners(); bit <<= 1, ++step) {
    const bool upper = (me & bit) != 0;
    const Part own = whole[step].half(upper), give = whole[step].half(!upper);
    exchange.swap_with(me ^ bit, vectors.mine(give.first), vectors.bytes(give.size()), vectors.theirs(own.first),
                       vectors.bytes(own.size()));
    if (!exchange.spoilt()) vectors.merge(own.first, own.size(), !upper);
    whole[step + 1] = own;
  }
  if (exchange.spoilt()) return;  // as all know by now
  for (int bit = exchange.corners() >> 1; bit > 0; bit >>= 1) {
    const bool upper = (me & bit) != 0;
    --step;
    const Part have = whole[step].half(upper), lack = whole[step].half(!upper);
    exchange.swap_with(me ^ bit, vectors.mine(have.first), vectors.bytes(have.size()), vectors.mine(lack.first),
                       vectors.bytes(lack.size()));
  }
}

}  // namespace

bool reduce_by_network(const DimensionExchange& exchange, const messages::Reduction& reduction, void* x,
                       std::size_t n) {
  messages::Process& self = messages::process();
  if (self.collectives() != messages::CollectiveMethod::network || exchange.spoilt()) return false;
  return exchange.count() == self.backend().nodes() && self.reduce(reduction, x, n);
}

void reduce(DimensionExchange& exchange, const Operation& operation, void* x, std::size_t n, void* work) {
  const int me = exchange.position();
  const int corners = exchange.corners();
  const Vectors vectors{operation, static_cast<std::byte*>(x), static_cast<std::byte*>(work)};
  const std::size_t bytes = vectors.bytes(n);
  if (exchange.folded()) {
    exchange.send(me - corners, x, bytes);
    exchange.receive(me - corners, x, bytes);
    return;
  }
  if (exchange.folds()) {
    exchange.receive(me + corners, work, bytes);
    if (!exchange.spoilt()) vectors.merge(0, n, true);
  }
  if (bytes < kShared || corners < 4)
    double_up(exchange, vectors, n);
  else
    halve_and_double(exchange, vectors, n);
  if (exchange.folds()) exchange.send(me + corners, x, bytes);
}

}  // namespace mars::collectives
