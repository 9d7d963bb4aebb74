// How a C program joins the MPI job of which mpirun or srun made it a rank. The host, if there is one, is rank 0. Nodes
// wait in their first NX call until the host has made its cube, and those beyond it wait for the end.
#pragma once

#include <memory>
#include <optional>

#include "hal/messages/world.h"

namespace mars::mpi {

// Collective over all ranks. `host`: whether rank 0 is the host; none: it is if its program is no other
// rank's. `two_threads` of this program are to make NX calls, one at a time: a Failure where MPI forbids it.
std::unique_ptr<messages::World> join_mpi(std::optional<bool> host, bool two_threads);

}  // namespace mars::mpi
