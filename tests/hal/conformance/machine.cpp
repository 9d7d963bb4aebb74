// What MARS's hal has beside NX: sums in parts of the machine, memory of a machine's nodes, counts of traffic.
#include <algorithm>
#include <bit>
#include <cstdint>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "hal/collectives/group_sum.h"
#include "hal/messages/process.h"
#include "hal/messages/shared_memory.h"
#include "hal/nx/nx_global.h"
#include "hal/nx/nx_messages.h"
#include "tests/hal/conformance/expect.h"
#include "tests/hal/conformance/rules.h"
#include "tests/hal/conformance/talk.h"

namespace mars::conformance {
namespace {

// The order that hal/collectives/reduction.h promises, done by one; merge(a, b) leaves its result in a.
template <class T, class Merge>
T in_order(std::vector<T> values, const Merge& merge) {
  const std::size_t corners = std::bit_floor(values.size());
  for (std::size_t i = corners; i < values.size(); ++i) merge(values[i - corners], values[i]);
  for (std::size_t step = 1; step < corners; step <<= 1) {
    for (std::size_t i = 0; i < corners; i += 2 * step) merge(values[i], values[i + step]);
  }
  return values[0];
}

double sum_in_order(const std::vector<double>& values) {
  return in_order(values, [](double& a, double b) { a += b; });
}

double awkward(long node) { return 1.0 / (3 + static_cast<double>(node)) + 1e10 * static_cast<double>(node % 3); }

// All of 64 bits, so that sums are modulo 2^64 and no double holds them.
std::uint64_t scattered(long node) { return 0x9e3779b97f4a7c15u * (static_cast<std::uint64_t>(node) + 1); }

void sum_in(const collectives::Group& group) {
  if (mynode() < group.first || mynode() >= group.first + group.count) return;
  std::vector<std::uint64_t> x = {scattered(mynode()), 1}, high = x, work(2), all;
  for (int node = group.first; node < group.first + group.count; ++node) all.push_back(scattered(node));
  collectives::group_sum(group, x, work);
  collectives::group_high(group, high, work);
  expect_equal(x[0], std::accumulate(all.begin(), all.end(), std::uint64_t{0}));
  expect_equal(x[1], group.count);
  expect_equal(high[0], *std::max_element(all.begin(), all.end()));
  expect_equal(high[1], 1);
}

RULE(parts_of_the_machine_sum, "group_sum and group_high work on any range of nodes, on integers of 64 bits",
     "otherwise EBC's sums would be wrong") {
  if (is_host()) return;
  const int nodes = static_cast<int>(numnodes());
  const int step = std::max(1, nodes / 8);
  for (int first = 0; first < nodes; first += step)
    for (int count = 1; first + count <= nodes; count += step) sum_in({first, count});
  sum_in({0, nodes});
}

RULE(sums_have_one_order, "gdsum adds in the order that reduction.h promises, however long the vectors are",
     "another order would give other bits") {
  if (is_host()) return;
  constexpr std::size_t kScales = 17;
  std::vector<double> mine, wanted;
  for (std::size_t scale = 1; scale <= kScales; ++scale) {
    std::vector<double> all;
    for (long node = 0; node < numnodes(); ++node) all.push_back(static_cast<double>(scale) * awkward(node));
    mine.push_back(all[static_cast<std::size_t>(mynode())]);
    wanted.push_back(sum_in_order(all));
  }
  for (const long length : {1L, 100L, 2160L, 20'003L}) {
    std::vector<double> x(static_cast<std::size_t>(length)), work(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = mine[i % kScales];
    gdsum(x.data(), length, work.data());
    for (std::size_t i = 0; i < x.size(); ++i) expect_equal(x[i], wanted[i % kScales]);
  }
}

// n -> a n + b.
struct Map {
  std::int64_t a, b;
};

long compose(void* x, void* work) {
  Map& first = *static_cast<Map*>(x);
  const Map& then = *static_cast<const Map*>(work);
  first = {first.a * then.a % 10007, (first.b * then.a + then.b) % 10007};
  return 0;
}

RULE(gopf_has_one_order, "gopf combines in that order too, the lower node's operand always in x",
     "an operation that does not commute, like the composition of maps, would give another result") {
  if (is_host()) return;
  const auto map_of = [](long node) { return Map{2 + node, 3 * node + 1}; };
  std::vector<Map> maps;
  for (long node = 0; node < numnodes(); ++node) maps.push_back(map_of(node));
  const Map wanted = in_order(maps, [](Map& a, Map& b) { compose(&a, &b); });
  Map mine = map_of(mynode()), work{};
  gopf(&mine, sizeof mine, &work, compose);
  expect_equal(mine.a, wanted.a);
  expect_equal(mine.b, wanted.b);
}

RULE(a_machine_shares_memory, "the nodes of a machine see one block of memory, aligned to 64",
     "none has a block of its own") {
  if (is_host()) return;
  const messages::Neighbourhood here = messages::neighbourhood();
  // These tests run on one machine; where nodes are simulated, each has its own.
  if (here.count != 1) expect_equal(here.count, numnodes());
  expect_equal(here.machine, mynode() - here.index);
  expect_equal(here.index, here.count == 1 ? 0 : mynode());
  for (const std::size_t size : {0, 1, 1000, 500'000}) {
    const messages::SharedMemory memory(size);
    expect_equal(memory.bytes().size(), size);
    expect_equal(reinterpret_cast<std::uintptr_t>(memory.bytes().data()) % 64, 0);
    const auto wanted = [](std::size_t i) { return static_cast<std::byte>(i % 251); };
    for (std::size_t i = here.index; i < size; i += here.count) memory.bytes()[i] = wanted(i);
    gsync();
    const std::size_t step = size > 1000 ? 97 : 1;
    for (std::size_t i = 0; i < size; i += step) expect(memory.bytes()[i] == wanted(i), "every node's bytes are seen");
    gsync();
  }
}

RULE(traffic_is_counted, "traffic() counts messages and bytes to nodes and to the host", "receives do not count") {
  const messages::Traffic before = messages::traffic();
  char bytes[100] = "";
  if (mynode() == 0) {
    csend(90, bytes, 100, -1, 0);
    csend(90, bytes, 7, myhost(), 0);
    msgwait(isend(90, bytes, 3, myhost(), 0));
    const auto nodes = static_cast<std::uint64_t>(numnodes() - 1);
    expect_equal(messages::traffic().to_nodes.messages - before.to_nodes.messages, nodes);
    expect_equal(messages::traffic().to_nodes.bytes - before.to_nodes.bytes, 100 * nodes);
    expect_equal(messages::traffic().to_host.messages - before.to_host.messages, 2);
    expect_equal(messages::traffic().to_host.bytes - before.to_host.bytes, 10);
    return;
  }
  crecv(90, bytes, 100);
  if (is_host()) crecv(90, bytes, 100);
  expect_equal(messages::traffic().to_nodes.bytes, before.to_nodes.bytes);
}

// While each rank but node 0 is in `wait`, it sends node 0 what it is called for; only then node 0 does `release`. A
// simulated rank is not called.
void expect_called(const std::function<void()>& wait, const std::function<void()>& release) {
  constexpr long kCalled = 96;
  const bool is_called = messages::process().backend().has_machine_clock();
  if (mynode() == 0) {
    for (long rank = is_called ? numnodes() : 0; rank > 0; --rank) receive_empty(kCalled);
    return release();
  }
  int calls = 0;
  messages::process().while_waiting([&] {
    if (calls++ > 0) return;
    send_empty(97, is_host() ? myhost() : mynode());
    while (iprobe(97) == 0) {
    }
    receive_empty(97);
    send_empty(kCalled, 0);
  });
  wait();
  messages::process().while_waiting({});
  expect_equal(calls > 0, is_called);
  expect(infotype() != 97, "info* are not of the message that was received meanwhile");
}

RULE(called_while_waiting, "a call that waits calls while_waiting, which may send and receive",
     "not on simulated ranks; the info* of the waiting call do not change") {
  constexpr long kGo = 95;
  const auto all_go = [] {
    send_empty(kGo, -1);
    send_empty(kGo, myhost());
  };
  const auto receive = [] { receive_empty(kGo); };
  expect_called(receive, all_go);
  expect_called([] { msgwait(irecv(kGo, nullptr, 0)); }, all_go);
  expect_called(
      [&] {
        cprobe(kGo);
        expect_equal(infotype(), kGo);
        receive();
      },
      all_go);
  expect_called(
      [&] {
        while (iprobe(kGo) == 0) flick();
        receive();
      },
      all_go);
  const auto sum = [] {
    double x = 1, work = 0;
    if (!is_host()) gdsum(&x, 1, &work);
  };
  const auto wait_in = [&](const std::function<void()>& call) {
    expect_called([&] { is_host() ? receive() : call(); },
                  [&] {
                    if (mynode() == 0) send_empty(kGo, myhost());
                    call();
                  });
  };
  wait_in(sum);
  wait_in(gsync);
}

RULE(called_while_waiting_may_throw, "an exception of while_waiting ends the call that waits",
     "the call can be made again") {
  if (mynode() == 0) {
    for (long rank = numnodes(); rank > 0; --rank) receive_empty(96);
    send_empty(95, -1);
    return send_empty(95, myhost());
  }
  messages::process().while_waiting([] { throw std::runtime_error("waits too long"); });
  bool thrown = !messages::process().backend().has_machine_clock();
  try {
    if (!thrown) crecv(95, nullptr, 0);
  } catch (const std::runtime_error& failure) {
    thrown = failure.what() == std::string("waits too long");
  }
  messages::process().while_waiting({});
  expect(thrown, "the call ended by what was thrown");
  send_empty(96, 0);
  receive_empty(95);
}

}  // namespace
}  // namespace mars::conformance
