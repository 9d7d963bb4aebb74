// Global operations: all nodes call, in the same order, with equal lengths.
#include <algorithm>
#include <bit>
#include <string>
#include <vector>

#include "hal/nx/nx_global.h"
#include "hal/nx/nx_messages.h"
#include "tests/hal/conformance/expect.h"
#include "tests/hal/conformance/rules.h"
#include "tests/hal/conformance/talk.h"

namespace mars::hal::conformance {
namespace {

RULE(gsync_waits_for_all, "gsync returns when all nodes have called it", "no node leaves before the last has come") {
  if (is_host()) return;
  if (mynode() == numnodes() - 1) let_pass(0.03);
  double last_to_come = dclock();  // one machine's clock
  gsync();
  const double left = dclock();
  double work = 0;
  gdhigh(&last_to_come, 1, &work);
  expect(left >= last_to_come, "no one left before the last came");
}

RULE(sums_and_maxima, "gisum, gdsum and gdhigh work element by element, the result on every node",
     "no element is left out at any length") {
  if (is_host()) return;
  const long n = numnodes();
  for (const int length : {0, 1, 2, 1000, 20'000}) {
    std::vector<long> whole(length), whole_work(length);
    std::vector<double> real(length), high(length), work(length);
    for (int i = 0; i < length; ++i) {
      whole[i] = mynode() * i;
      real[i] = static_cast<double>(mynode()) * i;
      high[i] = static_cast<double>((mynode() * 7 + i) % n) - 3;
    }
    gisum(whole.data(), length, whole_work.data());
    gdsum(real.data(), length, work.data());
    gdhigh(high.data(), length, work.data());
    for (int i = 0; i < length; ++i) {
      expect_equal(whole[i], n * (n - 1) / 2 * i);
      expect_equal(real[i], static_cast<double>(n * (n - 1) / 2) * i);
      double highest = -4;
      for (int node = 0; node < n; ++node) highest = std::max(highest, static_cast<double>((node * 7 + i) % n) - 3);
      expect_equal(high[i], highest);
    }
  }
}

RULE(results_have_the_same_bits, "a sum that rounds is the same bits on every node", "also where order matters") {
  if (is_host()) return;
  double x = 1.0 / (3 + static_cast<double>(mynode())) + 1e10 * static_cast<double>(mynode() % 3);
  double work = 0;
  gdsum(&x, 1, &work);
  send_long(6, std::bit_cast<std::int64_t>(x), next_node());
  expect_equal(receive_long(6), std::bit_cast<std::int64_t>(x));
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

std::string part_of(long node) {
  return std::string(static_cast<std::size_t>(node * 5 % 7), static_cast<char>('a' + node % 26));
}

RULE(gcol_in_node_order, "gcol and gcolx put the parts of all nodes together in node order, of different lengths, empty too",
     "nothing is written behind the last") {
  if (is_host()) return;
  std::string all;
  std::vector<long> lengths;
  for (long node = 0; node < numnodes(); ++node) {
    all += part_of(node);
    lengths.push_back(static_cast<long>(part_of(node).size()));
  }
  const std::string mine = part_of(mynode());
  for (int again = 0; again < 3; ++again) {
    std::string y(all.size() + 3, '-');
    long count = -1;
    gcol(mine.data(), static_cast<long>(mine.size()), y.data(), static_cast<long>(y.size()), &count);
    expect_equal(count, all.size());
    expect_equal(y, all + "---");
    std::string z(all.size() + 1, '-');
    gcolx(mine.data(), lengths.data(), z.data());
    expect_equal(z, all + "-");
  }
}

RULE(gcol_that_does_not_fit, "gcol into less room than all parts need fails", "EQMSGLONG, on every node") {
  if (is_host()) return;
  const std::string mine = "part";
  const long all = 4 * numnodes();
  std::string y(all, '-');
  long count = 0;
  REFUSED(EQMSGLONG, gcol, (mine.data(), 4, y.data(), all - 1, &count), std::to_string(all) + " bytes");
  gsync();
}

}  // namespace
}  // namespace mars::hal::conformance
