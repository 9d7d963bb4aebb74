#include "tests/mpis/times.h"

#include <algorithm>
#include <cstdio>
#include <functional>
#include <vector>

#include "hal/nx/nx_global.h"
#include "hal/nx/nx_messages.h"

namespace mars::times {
namespace {

constexpr int kRounds = 3;

// The longest that a node takes for one of several in a row; all nodes call.
void measure(const char* what, long bytes, double part, const std::function<void()>& once) {
  gsync();
  once();  // those who talk to each other leave it together
  const double begin = dclock();
  for (int round = 0; round < kRounds; ++round) once();
  double longest = (dclock() - begin) / kRounds * part, work = 0;
  gdhigh(&longest, 1, &work);
  if (mynode() != 0) return;
  std::printf("%-20s %8ld %14.1f\n", what, bytes, 1e6 * longest);
  std::fflush(stdout);
}

void ping_pong(const char* what, long other, long bytes) {
  std::vector<char> data(static_cast<std::size_t>(bytes));
  // Node 0's view: its peer begins before it.
  measure(what, bytes, mynode() == 0 ? 0.5 : 0, [&] {
    if (mynode() != 0 && mynode() != other) return;
    const long peer = mynode() == 0 ? other : 0;
    if (mynode() == 0) csend(1, data.data(), bytes, peer, 0);
    crecv(1, data.data(), bytes);
    if (mynode() != 0) csend(1, data.data(), bytes, peer, 0);
  });
}

void sum(long n) {
  std::vector<double> x(static_cast<std::size_t>(n)), work(x);
  measure("gdsum", n * 8, 1, [&] { gdsum(x.data(), n, work.data()); });
}

}  // namespace

void measure_all() {
  for (const long bytes : {0, 100, 101, 10000})
    if (numnodes() > 1) ping_pong("to a neighbour", 1, bytes);
  if (numnodes() > 2) ping_pong("across the cube", numnodes() - 1, 0);
  measure("gsync", 0, 1, gsync);
  for (const long n : {1, 1000}) sum(n);
}

}  // namespace mars::times
