#include "tests/bench/messages/raw.h"

#include <mpi.h>

#include "hal/nx/nx_messages.h"

namespace mars::bench {
namespace {

constexpr int kTag = 7;

MPI_Comm all = MPI_COMM_NULL;    // ranks are NX's ids
MPI_Comm nodes = MPI_COMM_NULL;  // as `all`, without the host

}  // namespace

void raw_start() {
  MPI_Comm_split(MPI_COMM_WORLD, 0, static_cast<int>(mynode()), &all);
  MPI_Comm_split(all, mynode() == myhost() ? MPI_UNDEFINED : 0, static_cast<int>(mynode()), &nodes);
}

void raw_stop() {
  if (nodes != MPI_COMM_NULL) MPI_Comm_free(&nodes);
  MPI_Comm_free(&all);
}

void raw_meet() { MPI_Barrier(all); }

void raw_send(const void* data, std::size_t length, int to) {
  MPI_Send(data, static_cast<int>(length), MPI_BYTE, to, kTag, all);
}

void raw_receive(void* data, std::size_t length, int from) {
  MPI_Recv(data, static_cast<int>(length), MPI_BYTE, from, kTag, all, MPI_STATUS_IGNORE);
}

void raw_sum(double* x, std::size_t n) {
  MPI_Allreduce(MPI_IN_PLACE, x, static_cast<int>(n), MPI_DOUBLE, MPI_SUM, nodes);
}

}  // namespace mars::bench
