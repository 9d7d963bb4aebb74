// What a program that calls MPI itself would do: the other side of the comparison. Collective calls of all ranks
// where it says so; ids are NX's, the host's too.
#pragma once

#include <cstddef>

namespace mars::bench {

// Collective over all ranks of the job, once NX knows who is who; the end as well.
void raw_start();
void raw_stop();
void raw_meet();

// MPI_Send and MPI_Recv.
void raw_send(const void* data, std::size_t length, int to);
void raw_receive(void* data, std::size_t length, int from);

// MPI_Allreduce of the nodes, in place.
void raw_sum(double* x, std::size_t n);

}  // namespace mars::bench
