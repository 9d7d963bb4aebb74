// Sparse all-to-all by each route: every node has as many bytes for each of a few others. Printed: microseconds from
// when all begin until the last has all, the best of a few rounds: bench-routes [ROUNDS [MOST-BYTES
// [crystal|direct|mpi]]]. Under mpirun or smpirun, the first rank is the host.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "hal/collectives/crystal_router.h"
#include "hal/mpi/start.h"
#include "hal/nx/nx_global.h"
#include "hal/nx/nx_messages.h"

namespace mars::bench {
namespace {

constexpr long kDone = 8;

// Seconds of the slowest node.
double once(collectives::CrystalRouter& router, const std::vector<collectives::Parcel>& parcels,
            collectives::Route route) {
  gsync();
  const double begin = dclock();
  router.exchange({0, static_cast<int>(numnodes())}, parcels, route);
  double seconds = dclock() - begin, work = 0;
  gdhigh(&seconds, 1, &work);
  return seconds;
}

struct Named {
  const char* name;
  collectives::Route route;
};
constexpr Named kRoutes[] = {{"crystal", collectives::Route::crystal},
                             {"direct", collectives::Route::direct},
                             {"mpi", collectives::Route::network}};

void measure(int others, std::size_t bytes, int rounds, const std::string& only) {
  const auto nodes = static_cast<int>(numnodes());
  std::mt19937 random(static_cast<unsigned>(mynode()));
  const std::vector<std::byte> data(bytes);
  std::vector<collectives::Parcel> parcels;
  for (int i = 0; i < others; ++i) parcels.push_back({static_cast<int>(random() % static_cast<unsigned>(nodes)), data});
  collectives::CrystalRouter router;
  std::vector<double> best;
  for (const Named& each : kRoutes) {
    if (!only.empty() && only != each.name) continue;
    best.push_back(1e9);
    for (int round = 0; round < rounds; ++round) best.back() = std::min(best.back(), once(router, parcels, each.route));
  }
  if (mynode() != 0) return;
  std::printf("%6d%8d%10zu", nodes, others, bytes);
  for (const double seconds : best) std::printf("%14.1f", 1e6 * seconds);
  std::printf("\n");
}

int run(int argc, char** argv) {
  std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 100;
  const std::size_t most = argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 65536;
  if (mynode() == myhost()) {
    crecv(kDone, nullptr, 0);
    return 0;
  }
  const std::string only = argc > 3 ? argv[3] : "";
  if (mynode() == 0)
    std::printf("%6s%8s%10s  %s\n", "nodes", "others", "bytes",
                only.empty() ? "  crystal us     direct us        MPI us" : only.c_str());
  for (const int others : {4, 16})
    for (const std::size_t bytes : {8ul, 256ul, 4096ul, 65536ul})
      if (bytes <= most) measure(others, bytes, rounds, only);
  gsync();
  if (mynode() == 0) csend(kDone, nullptr, 0, myhost(), 0);
  return 0;
}

}  // namespace
}  // namespace mars::bench

int main(int argc, char** argv) { return mars::mpi::run_mpi(argc, argv, mars::mpi::Role::by_rank, mars::bench::run); }
