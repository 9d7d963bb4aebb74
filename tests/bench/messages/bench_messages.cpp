// NX's calls beside MPI's own in one run, in turn: mpirun -n 2 bench-messages (the host and one node: ping-pong,
// and what waiting costs), mpirun -n 3 and more (the nodes' sums, while the host sleeps).
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "hal/mpi/start.h"
#include "hal/nx/nx_global.h"
#include "hal/nx/nx_messages.h"
#include "hal/messages/process.h"
#include "tests/bench/messages/raw.h"

namespace mars::bench {
namespace {

constexpr int kRounds = 200;
constexpr long kType = 7;
constexpr long kDone = 8;

// Microseconds of one call or message.
struct Times {
  double best = 0;
  double middle = 0;
};

Times times_of(std::vector<double>& seconds) {
  std::sort(seconds.begin(), seconds.end());
  return {1e6 * seconds.front(), 1e6 * seconds[seconds.size() / 2]};
}

double seconds_of(int count, const std::function<void()>& once) {
  const double begin = dclock();
  for (int i = 0; i < count; ++i) once();
  return (dclock() - begin) / count;
}

// Both in turn, so that a busy machine hits both alike. `ranks` all call; what this one saw.
void compare(const char* what, int count, double part, const std::function<void()>& meet,
             const std::function<void()>& ours, const std::function<void()>& theirs) {
  std::vector<double> nx, mpi;
  for (int round = 0; round < kRounds; ++round) {
    meet();
    nx.push_back(part * seconds_of(count, ours));
    meet();
    mpi.push_back(part * seconds_of(count, theirs));
  }
  const Times a = times_of(nx), b = times_of(mpi);
  if (mynode() == 0)
    std::printf("%-24s%10.3f%10.3f%8.3f%12.3f%10.3f%8.3f\n", what, a.best, b.best, a.best / b.best, a.middle, b.middle,
                a.middle / b.middle);
}

void print_head() {
  std::printf("%-24s%10s%10s%8s%12s%10s%8s\n", "microseconds", "best NX", "MPI", "ratio", "middle NX", "MPI", "ratio");
}

struct Size {
  const char* name;
  std::size_t bytes;
  int count;
};

// Half of a message to the other rank and back.
void ping_pong() {
  const int other = mynode() == 0 ? static_cast<int>(myhost()) : 0;
  std::vector<char> out(8 << 20, 'o'), in(8 << 20, 'i');
  const bool first = mynode() == 0;
  const auto turns = [first](const std::function<void()>& send, const std::function<void()>& receive) {
    return [=] {
      if (first) send();
      receive();
      if (!first) send();
    };
  };
  for (const Size& size : {Size{"8 B", 8, 2000}, Size{"1 KiB", 1024, 2000}, Size{"64 KiB", 65536, 100},
                           Size{"1 MiB", 1 << 20, 10}, Size{"8 MiB", 8 << 20, 2}}) {
    const auto length = static_cast<long>(size.bytes);
    compare(
        (std::string("csend, crecv ") + size.name).c_str(), size.count, 0.5, raw_meet,
        turns([&] { csend(kType, out.data(), length, other, 0); }, [&] { crecv(kType, in.data(), length); }),
        turns([&] { raw_send(out.data(), size.bytes, other); }, [&] { raw_receive(in.data(), size.bytes, other); }));
  }
}

double processor_seconds() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// What of a core the host uses while it waits for a message.
void wait_idly() {
  constexpr double kSeconds = 5;
  if (mynode() == 0) {
    std::this_thread::sleep_for(std::chrono::duration<double>(kSeconds));
    csend(kType, nullptr, 0, myhost(), 0);
  } else {
    const double before = processor_seconds();
    crecv(kType, nullptr, 0);
    std::printf("%-24s%9.2f %% of a core\n", "an idle host", 100 * (processor_seconds() - before) / kSeconds);
  }
}

void sums() {
  for (const auto& [means, name] :
       {std::pair{messages::CollectiveMethod::cube, "gdsum "}, {messages::CollectiveMethod::network, "gdsum by MPI "}})
    for (const Size& size : {Size{"1", 1, 1000}, Size{"2160", 2160, 100}, Size{"100000", 100'000, 4}}) {
      std::vector<double> x(size.bytes), work(size.bytes);
      const int count = std::max(2, size.count / static_cast<int>(numnodes() / 2));
      messages::process().set_collectives(means);
      compare((name + std::string(size.name)).c_str(), count, 1, [&] { raw_sum(x.data(), 1); },
              [&] { gdsum(x.data(), static_cast<long>(size.bytes), work.data()); },
              [&] { raw_sum(x.data(), size.bytes); });
    }
  messages::process().set_collectives(messages::CollectiveMethod::automatic);
}

int run(int, char**) {
  raw_start();
  std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);
  if (mynode() == 0) {
    std::printf("\n%ld node%s and the host\n", numnodes(), numnodes() == 1 ? "" : "s");
    print_head();
  }
  if (numnodes() == 1) {
    ping_pong();
    wait_idly();
  } else if (mynode() == myhost()) {
    crecv(kDone, nullptr, 0);
  } else {
    sums();
    gsync();
    if (mynode() == 0) csend(kDone, nullptr, 0, myhost(), 0);
  }
  raw_stop();
  return 0;
}

}  // namespace
}  // namespace mars::bench

int main(int argc, char** argv) { return mars::mpi::run_mpi(argc, argv, mars::mpi::Role::by_rank, mars::bench::run); }
