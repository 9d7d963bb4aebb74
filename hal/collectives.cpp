#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "hal/cube.h"
#include "hal/failure.h"
#include "hal/nx/nx_global.h"
#include "hal/nx/nx_messages.h"
#include "hal/process.h"

namespace mars::hal {
namespace {

// The calling node's place in a collective. Positions are node ids less the cube's first. The lowest 2^d of
// them form a hypercube; each of the others folds in with the one 2^d below it.
class Exchange {
 public:
  Exchange(const char* call, const Cube& cube) : call_(call), process_(process()), cube_(cube) {
    if (process_.backend().rank() == process_.backend().host()) {
      process_.fail(call, EQNODE, "the host takes no part in collectives", "call it on nodes only");
    }
    check(0 <= cube.first && 0 < cube.count && cube.first + cube.count <= process_.backend().nodes(),
          "a cube lies within the nodes");
    position_ = process_.backend().rank() - cube.first;
    check(0 <= position_ && position_ < cube.count, "a node takes part in its own cube");
  }

  int position() const { return position_; }
  int count() const { return cube_.count; }
  int corners() const { return static_cast<int>(std::bit_floor(static_cast<unsigned>(cube_.count))); }
  bool folded() const { return position_ >= corners(); }              // has a partner below
  bool folds() const { return position_ + corners() < cube_.count; }  // has a partner above

  void send(int to, const void* data, std::size_t bytes) {
    process_.send_internal(cube_.first + to, data, bytes);
  }
  void receive(int from, void* data, std::size_t bytes) {
    process_.receive_internal(call_, cube_.first + from, data, bytes);
  }

 private:
  const char* call_;
  Process& process_;
  Cube cube_;
  int position_;
};

// x = combine(x, theirs), the operand of the lower position first, so that both sides get the same bits.
template <class T, class Combine>
void merge(std::span<T> x, std::span<const T> theirs, bool mine_first, Combine combine) {
  if (mine_first) {
    std::transform(x.begin(), x.end(), theirs.begin(), x.begin(), combine);
  } else {
    std::transform(theirs.begin(), theirs.end(), x.begin(), x.begin(), combine);
  }
}

// Element-wise reduction, the result on all. Order, for floating point: first position p with p + 2^d where
// there is one; then neighbours across dimension 0, 1, ... d - 1.
template <class T, class Combine>
void reduce(const char* call, const Cube& cube, std::span<T> x, std::span<T> work, Combine combine) {
  check(work.size() >= x.size(), "work is as long as the values");
  Exchange exchange(call, cube);
  const int me = exchange.position();
  const int corners = exchange.corners();
  const std::span<T> theirs = work.first(x.size());
  if (exchange.folded()) {
    exchange.send(me - corners, x.data(), x.size_bytes());
    exchange.receive(me - corners, x.data(), x.size_bytes());
    return;
  }
  if (exchange.folds()) {
    exchange.receive(me + corners, theirs.data(), theirs.size_bytes());
    merge<T>(x, theirs, true, combine);
  }
  for (int bit = 1; bit < corners; bit <<= 1) {
    exchange.send(me ^ bit, x.data(), x.size_bytes());
    exchange.receive(me ^ bit, theirs.data(), theirs.size_bytes());
    merge<T>(x, theirs, (me & bit) == 0, combine);
  }
  if (exchange.folds()) exchange.send(me + corners, x.data(), x.size_bytes());
}

Cube all_nodes() { return {0, process().backend().nodes()}; }

std::size_t length(const char* call, long n) {
  if (n < 0)
    process().fail(call, EQLEN, "length " + std::to_string(n) + " is negative", "give the number of elements");
  return static_cast<std::size_t>(n);
}

template <class T, class Combine>
void reduce_all(const char* call, T* x, long n, T* work, Combine combine) {
  const std::size_t size = length(call, n);
  reduce(call, all_nodes(), std::span<T>(x, size), std::span<T>(work, size), combine);
}

constexpr auto higher = [](double a, double b) { return a < b ? b : a; };

// Node i's part of a concatenation is bytes [offset(i), offset(i + 1)) of y. Gathers all parts on all nodes,
// each node's own being in place already. What a node holds at each step is the parts of an aligned run of
// positions, and of those folded into them: two stretches of y.
template <class Offset>
void gather(Exchange& exchange, std::byte* y, Offset offset) {
  const int me = exchange.position();
  const int corners = exchange.corners();
  const auto stretch = [&](int first, int last) {
    const int from = std::min(first, exchange.count());
    const int to = std::min(last, exchange.count());
    return std::span<std::byte>(y + offset(from), offset(to) - offset(from));
  };
  const auto send = [&](int to, std::span<std::byte> bytes) {
    exchange.send(to, bytes.data(), bytes.size());
  };
  const auto receive = [&](int from, std::span<std::byte> bytes) {
    exchange.receive(from, bytes.data(), bytes.size());
  };
  if (exchange.folded()) {
    send(me - corners, stretch(me, me + 1));
    receive(me - corners, stretch(0, exchange.count()));
    return;
  }
  if (exchange.folds()) receive(me + corners, stretch(me + corners, me + corners + 1));
  for (int bit = 1; bit < corners; bit <<= 1) {
    const int mine = me & ~(bit - 1);
    const int theirs = mine ^ bit;
    send(me ^ bit, stretch(mine, mine + bit));
    send(me ^ bit, stretch(corners + mine, corners + mine + bit));
    receive(me ^ bit, stretch(theirs, theirs + bit));
    receive(me ^ bit, stretch(corners + theirs, corners + theirs + bit));
  }
  if (exchange.folds()) send(me + corners, stretch(0, exchange.count()));
}

// offsets[i] = bytes before node i's part, offsets[nodes] = all, from each node's length.
void add_up(std::span<const long> lengths, std::vector<std::size_t>& offsets) {
  offsets.resize(lengths.size() + 1);
  offsets[0] = 0;
  for (std::size_t i = 0; i < lengths.size(); ++i) offsets[i + 1] = offsets[i] + length("gcolx", lengths[i]);
}

void concatenate(Exchange& exchange, const void* x, const std::vector<std::size_t>& offsets, void* y) {
  auto* bytes = static_cast<std::byte*>(y);
  const std::size_t mine = offsets[exchange.position()];
  const std::size_t size = offsets[exchange.position() + 1] - mine;
  if (size > 0) std::memmove(bytes + mine, x, size);
  gather(exchange, bytes, [&offsets](int node) { return offsets[node]; });
}

// Used again by each call, so that steady use allocates nothing.
struct Scratch {
  std::vector<long> lengths;
  std::vector<std::size_t> offsets;
};
thread_local Scratch scratch;

}  // namespace

void cube_sum(const Cube& cube, std::span<double> values, std::span<double> work) {
  reduce("cube_sum", cube, values, work, std::plus<double>());
}

void cube_high(const Cube& cube, std::span<double> values, std::span<double> work) {
  reduce("cube_high", cube, values, work, higher);
}

}  // namespace mars::hal

using namespace mars::hal;

extern "C" {

void gsync(void) { reduce_all<long>("gsync", nullptr, 0, nullptr, std::plus<long>()); }
void gisum(long x[], long n, long work[]) { reduce_all("gisum", x, n, work, std::plus<long>()); }
void gdsum(double x[], long n, double work[]) { reduce_all("gdsum", x, n, work, std::plus<double>()); }
void gdhigh(double x[], long n, double work[]) { reduce_all("gdhigh", x, n, work, higher); }

void gcolx(const void* x, const long xlens[], void* y) {
  Exchange exchange("gcolx", all_nodes());
  add_up({xlens, static_cast<std::size_t>(exchange.count())}, scratch.offsets);
  concatenate(exchange, x, scratch.offsets, y);
}

void gcol(const void* x, long xlen, void* y, long ylen, long* ncnt) {
  Exchange exchange("gcol", all_nodes());
  std::vector<long>& lengths = scratch.lengths;
  lengths.resize(exchange.count());
  lengths[exchange.position()] = static_cast<long>(length("gcol", xlen));
  gather(exchange, reinterpret_cast<std::byte*>(lengths.data()),
         [](int node) { return node * sizeof(long); });
  add_up(lengths, scratch.offsets);
  const std::size_t all = scratch.offsets.back();
  if (all > length("gcol", ylen)) {
    process().fail("gcol", EQMSGLONG,
                   "the " + std::to_string(all) + " bytes of all nodes do not fit " + std::to_string(ylen),
                   "give a buffer for the bytes of all nodes");
  }
  concatenate(exchange, x, scratch.offsets, y);
  *ncnt = static_cast<long>(all);
}

}  // extern "C"
