#include "hal/mpi/start.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include <mpi.h>

#include "hal/failure/explain.h"
#include "hal/failure/failure.h"
#include "hal/messages/process.h"
#include "hal/mpi/mpi_backend.h"
#include "hal/mpi/mpi_call.h"
#include "hal/mpi/patience.h"

namespace mars::mpi {
namespace {

struct Roles {
  int hosts = 0;
  int nodes = 0;
  int host_rank = 0;  // of the first host
};

// The same on all ranks.
Roles gather_roles(Role role, int rank) {
  const int is_host = role == Role::host || (role == Role::by_rank && rank == 0);
  int size = 0;
  succeed(MPI_Comm_size(MPI_COMM_WORLD, &size), "MPI_Comm_size");
  std::vector<int> hosts(size);
  succeed(MPI_Allgather(&is_host, 1, MPI_INT, hosts.data(), 1, MPI_INT, MPI_COMM_WORLD), "MPI_Allgather");
  Roles roles;
  roles.hosts = static_cast<int>(std::count(hosts.begin(), hosts.end(), 1));
  roles.nodes = size - roles.hosts;
  roles.host_rank = static_cast<int>(std::find(hosts.begin(), hosts.end(), 1) - hosts.begin());
  return roles;
}

std::optional<Failure> misfit(const Roles& roles) {
  if (roles.hosts == 1 && roles.nodes >= 1) return std::nullopt;
  return Failure("an MPI job of one host and at least one node is needed, and this one has " +
                     std::to_string(roles.hosts) + " hosts and " + std::to_string(roles.nodes) + " nodes",
                 "", "start it as: mpirun -n 1 mars-host ... : -n 8 mars-node");
}

void print(const std::string& reason) { std::fprintf(stderr, "mars: %s\n", reason.c_str()); }

// `name` becomes the rank's name as soon as it is known.
int run_rank(Role role, const std::function<int()>& body, std::string& name) {
  int rank = 0;
  succeed(MPI_Comm_rank(MPI_COMM_WORLD, &rank), "MPI_Comm_rank");
  const Roles roles = gather_roles(role, rank);
  // All ranks come to the same verdict: each ends by itself, and one prints it.
  if (const std::optional<Failure> problem = misfit(roles)) {
    if (rank == 0) print(problem->what());
    return 1;
  }
  MpiBackend backend(roles.host_rank);
  name = messages::rank_name(backend.rank(), backend.host());
  messages::Process process(backend);
  const int code = body();
  process.finish();
  return code;
}

// A message call's failure names its rank already.
std::string named(const std::string& name, const std::string& reason) {
  return reason.starts_with(name) ? reason : name + ": " + reason;
}

}  // namespace

int run_mpi(int& argc, char**& argv, Role role, const std::function<int(int argc, char** argv)>& body) {
  int level = MPI_THREAD_SINGLE;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &level);
  if (level < MPI_THREAD_FUNNELED && !mpi_waits_well())
    abort_job("this MPI cannot be used by a process with threads; use another");
  MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
  prepare_to_wait();
  int code = 1;
  std::string name;
  try {
    code = run_rank(
        role, [&] { return body(argc, argv); }, name);
  } catch (const std::exception& failure) {
    abort_job(named(name, reason_of(failure)));
  }
  MPI_Finalize();
  return code;
}

}  // namespace mars::mpi
