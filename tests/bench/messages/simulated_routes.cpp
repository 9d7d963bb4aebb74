// The messages of the three routes of a sparse all-to-all, as hal/collectives/crystal_router.cpp sends them, without
// what NX does beside: so that smpirun can simulate a thousand nodes. Each has as many bytes for each of a few random
// others: bench-simulated-routes.so [OTHERS BYTES [crystal|direct|mpi]].
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <mpi.h>

namespace {

constexpr int kHead = 16;  // bytes before those of a parcel

struct Machine {
  int rank;
  int nodes;  // a power of two
};

// Parcels travel as their receivers, followed by as many bytes as they would have.
using Parcels = std::vector<int>;

Parcels given(const Machine& machine, int others) {
  std::mt19937 random(static_cast<unsigned>(machine.rank));
  Parcels parcels(static_cast<std::size_t>(others));
  for (int& to : parcels) to = static_cast<int>(random() % static_cast<unsigned>(machine.nodes));
  return parcels;
}

void crystal(const Machine& machine, const Parcels& parcels, int bytes, std::vector<char>& out, std::vector<char>& in) {
  Parcels held = parcels;
  for (int bit = 1; bit < machine.nodes; bit <<= 1) {
    const auto stays = [&](int to) { return (to & bit) == (machine.rank & bit); };
    const auto crossing = std::stable_partition(held.begin(), held.end(), stays);
    const auto count = held.end() - crossing;
    std::copy(crossing, held.end(), reinterpret_cast<int*>(out.data()));
    held.erase(crossing, held.end());
    MPI_Status status;
    const int other = machine.rank ^ bit;
    MPI_Sendrecv(out.data(), static_cast<int>(count) * (kHead + bytes), MPI_BYTE, other, 1, in.data(),
                 static_cast<int>(in.size()), MPI_BYTE, other, 1, MPI_COMM_WORLD, &status);
    int length = 0;
    MPI_Get_count(&status, MPI_BYTE, &length);
    const int* came = reinterpret_cast<const int*>(in.data());
    held.insert(held.end(), came, came + length / (kHead + bytes));
  }
}

struct Counts {
  std::vector<int> lengths;
  std::vector<int> offsets;

  explicit Counts(std::vector<int> of) : lengths(std::move(of)), offsets(lengths.size()) {
    for (std::size_t i = 1; i < offsets.size(); ++i) offsets[i] = offsets[i - 1] + lengths[i - 1];
  }
};

std::vector<int> lengths_to(const Machine& machine, const Parcels& parcels, int bytes) {
  std::vector<int> lengths(static_cast<std::size_t>(machine.nodes));
  for (const int to : parcels) lengths[static_cast<std::size_t>(to)] += kHead + bytes;
  return lengths;
}

void direct(const Machine& machine, const Parcels& parcels, int bytes, std::vector<char>& out, std::vector<char>& in) {
  const std::vector<int> lengths = lengths_to(machine, parcels, bytes);
  std::vector<MPI_Request> sends(static_cast<std::size_t>(machine.nodes), MPI_REQUEST_NULL);
  for (int i = 1; i < machine.nodes; ++i) {
    const int to = (machine.rank + i) % machine.nodes;
    MPI_Isend(out.data(), lengths[static_cast<std::size_t>(to)], MPI_BYTE, to, 2, MPI_COMM_WORLD,
              &sends[static_cast<std::size_t>(i)]);
  }
  for (int i = 1; i < machine.nodes; ++i)
    MPI_Recv(in.data(), static_cast<int>(in.size()), MPI_BYTE, (machine.rank + machine.nodes - i) % machine.nodes, 2,
             MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  MPI_Waitall(machine.nodes, sends.data(), MPI_STATUSES_IGNORE);
}

// First the lengths, then the bytes.
void network(const Machine& machine, const Parcels& parcels, int bytes, std::vector<char>& out, std::vector<char>& in) {
  const Counts to(lengths_to(machine, parcels, bytes));
  std::vector<int> lengths(to.lengths.size());
  MPI_Alltoall(to.lengths.data(), 1, MPI_INT, lengths.data(), 1, MPI_INT, MPI_COMM_WORLD);
  const Counts from(lengths);
  MPI_Alltoallv(out.data(), to.lengths.data(), to.offsets.data(), MPI_BYTE, in.data(), from.lengths.data(),
                from.offsets.data(), MPI_BYTE, MPI_COMM_WORLD);
}

struct Route {
  const char* name;
  void (*go)(const Machine&, const Parcels&, int bytes, std::vector<char>& out, std::vector<char>& in);
};
constexpr Route kRoutes[] = {{"crystal", crystal}, {"direct", direct}, {"mpi", network}};

void measure(const Machine& machine, int others, int bytes, const std::string& only) {
  const Parcels parcels = given(machine, others);
  const std::size_t room = static_cast<std::size_t>(8 * others + 64) * static_cast<std::size_t>(kHead + bytes);
  std::vector<char> out(room), in(room);
  if (machine.rank == 0) std::printf("%6d%8d%10d", machine.nodes, others, bytes);
  for (const Route& route : kRoutes) {
    if (!only.empty() && only != route.name) continue;
    MPI_Barrier(MPI_COMM_WORLD);
    const double begin = MPI_Wtime();
    route.go(machine, parcels, bytes, out, in);
    double seconds = MPI_Wtime() - begin, slowest = 0;
    MPI_Reduce(&seconds, &slowest, 1, MPI_DOUBLE, MPI_MAX, 0, MPI_COMM_WORLD);
    if (machine.rank == 0) std::printf("%14.1f", 1e6 * slowest);
  }
  if (machine.rank == 0) std::printf("\n");
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);
  Machine machine{};
  MPI_Comm_rank(MPI_COMM_WORLD, &machine.rank);
  MPI_Comm_size(MPI_COMM_WORLD, &machine.nodes);
  if (machine.rank == 0)
    std::printf("%6s%8s%10s%14s%14s%14s\n", "nodes", "others", "bytes", "crystal us", "direct us", "MPI us");
  const std::string only = argc > 3 ? argv[3] : "";
  if (argc > 2)
    measure(machine, std::atoi(argv[1]), std::atoi(argv[2]), only);
  else
    for (const int others : {4, 16})
      for (const int bytes : {8, 256, 4096}) measure(machine, others, bytes, only);
  MPI_Finalize();
  return 0;
}
