// A rank of jobs that must end with a failure, quickly (mpi_faults_test.cpp): argument 1 says how, or 1 the
// way and 2 the moment (faults/faults.h).
#include <algorithm>
#include <cstddef>
#include <map>
#include <string>

#include "hal/failure/failure.h"
#include "hal/messages/process.h"
#include "hal/messages/shared_memory.h"
#include "hal/mpi/start.h"
#include "hal/nx/nx_global.h"
#include "hal/nx/nx_messages.h"
#include "tests/hal/faults/faults.h"

namespace mars::messages {
namespace {

void wait_for_ever() { crecv(1, nullptr, 0); }

void node_throws() {
  if (mynode() == 1) throw Failure("a fault on purpose", "", "");
  wait_for_ever();
}

void node_throws_sharing_memory() {
  if (mynode() == myhost()) wait_for_ever();
  const SharedMemory memory(1000);
  node_throws();
}

void host_throws() {
  if (mynode() == myhost()) throw Failure("a fault on purpose", "", "");
  wait_for_ever();
}

void message_too_long() {
  char bytes[200] = "";
  if (mynode() == 0) csend(1, bytes, 200, 1, 0);
  if (mynode() == 1) crecv(1, bytes, 100);
  wait_for_ever();
}

void too_much_shared_memory() {
  if (mynode() != myhost()) SharedMemory(std::size_t{1} << 50);
  wait_for_ever();
}

void apart() {
  if (mynode() == myhost()) {
    for (long node = 0; node < numnodes(); ++node) crecv(2, nullptr, 0);
    return;
  }
  const Neighbourhood here = neighbourhood();
  if (here.machine != mynode() || here.count != 1 || here.refusal.empty() ||
      machine_neighbourhood().count != numnodes())
    throw Failure("nodes that cannot see each other's memory share it", "", "");
  const SharedMemory memory(1000);
  memory.bytes()[0] = std::byte{1};
  csend(2, nullptr, 0, myhost(), 0);
}

void fills_shared_memory() {
  if (mynode() == myhost()) return;
  const SharedMemory memory(8 << 20);
  if (mynode() == 0) std::fill(memory.bytes().begin(), memory.bytes().end(), std::byte{3});
  gsync();
  if (memory.bytes().back() != std::byte{3}) throw Failure("nodes share no memory", "", "");
}

void nothing() {}

// Nobody receives these.
void leaves_messages() {
  static char bytes[1 << 20];
  csend(1, bytes, sizeof bytes, -1, 0);
  csend(1, bytes, 8, -1, 0);
}

int run(int argc, char** argv) {
  const std::map<std::string, void (*)()> faults = {
      {"host", nothing},
      {"node", nothing},
      {"node_throws", node_throws},
      {"node_throws_sharing_memory", node_throws_sharing_memory},
      {"host_throws", host_throws},
      {"message_too_long", message_too_long},
      {"too_much_shared_memory", too_much_shared_memory},
      {"leaves_messages", leaves_messages},
      {"apart", apart},
      {"fills_shared_memory", fills_shared_memory},
  };
  if (argc > 2)
    faults::run_rank({argv[1], argv[2]});
  else
    faults.at(argv[1])();
  return 0;
}

}  // namespace
}  // namespace mars::messages

int main(int argc, char** argv) {
  using mars::mpi::Role;
  const std::string how = argc > 1 ? argv[1] : "";
  const Role role = how == "host" ? Role::host : how == "node" ? Role::node : Role::by_rank;
  return mars::mpi::run_mpi(argc, argv, role, mars::messages::run);
}
