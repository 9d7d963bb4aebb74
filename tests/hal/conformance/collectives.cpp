// Global operations: all nodes call, in the same order, with equal lengths.
#include <array>
#include <cerrno>
#include <set>
#include <string>
#include <vector>

#include "hal/nx/nx_global.h"
#include "hal/nx/nx_messages.h"
#include "tests/hal/conformance/expect.h"
#include "tests/hal/conformance/rules.h"
#include "tests/hal/conformance/talk.h"

namespace mars::conformance {
namespace {

// Whose arguments are wrong in turn: the first, one between, the last.
std::set<long> some_nodes() { return {0, numnodes() / 2, numnodes() - 1}; }

void expect_in_step() {
  long one = 1, work = 0;
  gisum(&one, 1, &work);
  expect_equal(one, numnodes());
}

RULE(gsync_waits_for_all, "gsync returns when all nodes have called it", "no node leaves before the last has come") {
  if (is_host()) return;
  if (mynode() == numnodes() - 1) let_pass(0.005);
  double last_to_come = dclock();  // one machine's clock
  gsync();
  const double left = dclock();
  double work = 0;
  gdhigh(&last_to_come, 1, &work);
  expect(left >= last_to_come, "no one left before the last came");
}

RULE(results_have_the_same_bits, "rounded results have the same bits on every node",
     "also if the order of operations matters") {
  if (is_host()) return;
  const double awkward = 1.0 / (3 + static_cast<double>(mynode())) + 1e10 * static_cast<double>(mynode() % 3);
  double sum = awkward, product = 1 / awkward + 1, work = 0;
  auto single = static_cast<float>(awkward), single_work = 0.0f;
  gdsum(&sum, 1, &work);
  gdprod(&product, 1, &work);
  gssum(&single, 1, &single_work);
  const std::array<double, 3> mine = {sum, product, single};
  std::array<double, 3> theirs = {};
  csend(6, mine.data(), sizeof mine, next_node(), 0);
  crecv(6, theirs.data(), sizeof theirs);
  expect(theirs == mine, "the neighbour has the same");
}

RULE(collectives_are_not_messages, "global operations and messages do not mix",
     "a posted receive of -1 gets nothing of a collective") {
  if (is_host()) return;
  long any = 0;
  const long mid = irecv(-1, &any, sizeof any);
  send_long(81, 5, next_node());
  long x = 1, work = 0;
  gisum(&x, 1, &work);
  gsync();
  expect_equal(x, numnodes());
  msgwait(mid);
  expect_equal(any, 5);
  expect_equal(infotype(), 81);
  expect_equal(iprobe(-1), 0);
}

std::string part_of(long node, long scale) {
  return std::string(static_cast<std::size_t>(scale * (node * 5 % 7)), static_cast<char>('a' + node % 26));
}

RULE(gcol_in_node_order,
     "gcol and gcolx join the parts of all nodes in node order; parts may have different lengths, or be empty",
     "nothing is written behind the last part") {
  if (is_host()) return;
  for (const long scale : {0L, 1L, 5000L}) {
    std::string all;
    std::vector<long> lengths;
    for (long node = 0; node < numnodes(); ++node) {
      all += part_of(node, scale);
      lengths.push_back(static_cast<long>(part_of(node, scale).size()));
    }
    const std::string mine = part_of(mynode(), scale);
    std::string y(all.size() + 3, '-'), z = y;
    long count = -1;
    gcol(mine.data(), static_cast<long>(mine.size()), y.data(), static_cast<long>(y.size()), &count);
    expect_equal(count, all.size());
    expect(y == all + "---", "gcol put them together");
    gcolx(mine.data(), lengths.data(), z.data());
    expect(z == all + "---", "gcolx put them together");
  }
}

RULE(gcol_that_does_not_fit, "gcol into a buffer shorter than all parts together fails",
     "EQMSGLONG on every node, also if the buffer of only one node is too short") {
  if (is_host()) return;
  const std::string mine = "part";
  const long all = 4 * numnodes();
  std::string y(static_cast<std::size_t>(all), '-');
  long count = 0;
  REFUSED(EQMSGLONG, gcol, (mine.data(), 4, y.data(), all - 1, &count), std::to_string(all) + " bytes");
  for (const long small : some_nodes())
    expect_errno(EQMSGLONG, [&] { return _gcol(mine.data(), 4, y.data(), all - (mynode() == small), &count); });
  expect_in_step();
}

RULE(wrong_on_one_node, "a wrong argument on one node fails the call on all nodes that wait for this node",
     "EQLEN on every node, whichever node is wrong; later calls work") {
  if (is_host()) return;
  double x = 1, work = 0;
  for (const long wrong : some_nodes())
    expect_errno(EQLEN, [&] { return _gdsum(&x, mynode() == wrong ? -1 : 1, &work); });
  expect_in_step();
}

RULE(different_lengths, "a vector of another length on one node is EQLEN on all",
     "nothing is written behind the shorter one; later calls work") {
  if (is_host() || numnodes() == 1) return;
  struct Lengths {
    long usual, odd;
  };
  for (const auto& [usual, odd] : {Lengths{1, 2}, {5, 0}, {20'000, 1}, {0, 20'000}, {8'100, 8'300}})
    for (const long other : some_nodes()) {
      const long length = mynode() == other ? odd : usual;
      const auto behind = static_cast<std::size_t>(length);
      std::vector<double> x(behind + 1, 1.0), work(x.size());
      x[behind] = work[behind] = -7;
      expect_errno(EQLEN, [&] { return _gdsum(x.data(), length, work.data()); });
      expect(x[behind] == -7 && work[behind] == -7, "what lies behind is untouched");
      expect_in_step();
    }
}

RULE(different_lists_of_lengths, "another list on one node fails gcolx with EQLEN",
     "on one node at least; not on all, because not all can notice it") {
  if (is_host() || numnodes() == 1) return;
  std::vector<char> x(16), y(static_cast<std::size_t>(16 * numnodes()));
  for (const long other : some_nodes()) {
    std::vector<long> lengths(static_cast<std::size_t>(numnodes()), 8);
    if (mynode() == other) lengths[0] = 16;
    long failed = _gcolx(x.data(), lengths.data(), y.data()) == -1, work = 0;
    if (failed == 1) expect_equal(errno, EQLEN);
    gisum(&failed, 1, &work);
    expect(failed >= 1, "it fails on one");
  }
}

}  // namespace
}  // namespace mars::conformance
