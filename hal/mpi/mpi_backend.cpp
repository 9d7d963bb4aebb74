#include "hal/mpi/mpi_backend.h"

#include <sched.h>
#include <sys/statvfs.h>

#include <climits>
#include <exception>

#include "hal/failure/failure.h"
#include "hal/messages/message_types.h"
#include "hal/mpi/mpi_call.h"
#include "hal/mpi/patience.h"
#include "topology/machine.h"
#include "topology/placement.h"

namespace mars::mpi {
namespace {

constexpr std::size_t kAlignment = 64;

constexpr std::size_t kUsuallyPending = 1024;

struct Affinity {
  cpu_set_t some;   // processors that at least one rank may use
  cpu_set_t every;  // processors that every rank may use
};

// Of the ranks of `comm`.
Affinity affinity(MPI_Comm comm) {
  cpu_set_t mine;
  CPU_ZERO(&mine);
  sched_getaffinity(0, sizeof mine, &mine);
  Affinity all;
  succeed(MPI_Allreduce(&mine, &all.some, sizeof mine, MPI_BYTE, MPI_BOR, comm), "MPI_Allreduce");
  succeed(MPI_Allreduce(&mine, &all.every, sizeof mine, MPI_BYTE, MPI_BAND, comm), "MPI_Allreduce");
  return all;
}

// MPI knows it of MPI_COMM_WORLD only.
int highest_tag() {
  int* highest = nullptr;
  int known = 0;
  succeed(MPI_Comm_get_attr(MPI_COMM_WORLD, MPI_TAG_UB, &highest, &known), "MPI_Comm_get_attr");
  return known ? *highest : 32767;
}

MPI_Comm split_by_machine(MPI_Comm comm, int key) {
  MPI_Comm machine = MPI_COMM_NULL;
  succeed(MPI_Comm_split_type(comm, MPI_COMM_TYPE_SHARED, key, MPI_INFO_NULL, &machine), "MPI_Comm_split_type");
  return machine;
}

// The lowest rank of `comm` on this machine.
int machine_of(MPI_Comm comm) {
  int lowest = rank_in(comm);
  MPI_Comm here = split_by_machine(comm, lowest);
  succeed(MPI_Bcast(&lowest, 1, MPI_INT, 0, here), "MPI_Bcast");
  succeed(MPI_Comm_free(&here), "MPI_Comm_free");
  return lowest;
}

// Of `ranks`, whose rank there is the id: first the nodes by place, then the host.
MPI_Comm ranks_by_id(int host_rank, MPI_Comm ranks) {
  const int rank = rank_in(ranks);
  const topology::Spot mine{machine_of(ranks), topology::Machine::binding().first_core};
  std::vector<topology::Spot> spots(size_of(ranks));
  succeed(MPI_Allgather(&mine, sizeof mine, MPI_BYTE, spots.data(), sizeof mine, MPI_BYTE, ranks), "MPI_Allgather");
  if (host_rank >= 0) spots.erase(spots.begin() + host_rank);
  std::vector<int> ids = topology::number_nodes(spots);
  if (host_rank >= 0) ids.insert(ids.begin() + host_rank, static_cast<int>(spots.size()));
  MPI_Comm all = MPI_COMM_NULL;
  succeed(MPI_Comm_split(ranks, 0, ids[rank], &all), "MPI_Comm_split");
  return all;
}

}  // namespace

MpiBackend::MpiBackend(int host_rank, MPI_Comm ranks) : all_(ranks_by_id(host_rank, ranks)) {
  succeed(MPI_Comm_set_errhandler(all_, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
  nodes_ = size_of(all_) - (host_rank >= 0 ? 1 : 0);
  rank_ = rank_in(all_);
  wide_tag_ = highest_tag();
  last_tag_ = wide_tag_ - 2 - nodes_;
  longest_plain_ = INT_MAX - sizeof(std::int32_t);  // for a type may follow
  sent_to_.resize(nodes_ + 1);
  pending_.reserve(kUsuallyPending);
  look_around();
}

void MpiBackend::look_around() {
  MPI_Comm ranks_here = split_by_machine(all_, rank_);
  const cpu_set_t usable = affinity(ranks_here).some;
  oversubscribed_ = size_of(ranks_here) > CPU_COUNT(&usable);
  bells_.emplace(ranks_here, all_);
  succeed(MPI_Comm_free(&ranks_here), "MPI_Comm_free");

  succeed(MPI_Comm_split(all_, rank_ == host() ? MPI_UNDEFINED : 0, rank_, &nodes_only_), "MPI_Comm_split");
  if (nodes_only_ == MPI_COMM_NULL) return;
  machine_ = split_by_machine(nodes_only_, rank_);
  const Affinity given = affinity(machine_);
  neighbourhood_ = {rank_, rank_in(machine_), size_of(machine_), rank_in(MPI_COMM_WORLD),
                    !CPU_EQUAL(&given.some, &given.every)};
  succeed(MPI_Bcast(&neighbourhood_.machine, 1, MPI_INT, 0, machine_), "MPI_Bcast");
}

MpiBackend::~MpiBackend() {
  if (ending_ != Ending::ended) return;
  bells_->take_down();
  if (machine_ != MPI_COMM_NULL) MPI_Comm_free(&machine_);
  if (nodes_only_ != MPI_COMM_NULL) MPI_Comm_free(&nodes_only_);
  MPI_Comm_free(&all_);
}

double MpiBackend::seconds() const { return mpi_waits_well() ? MPI_Wtime() : messages::machine_seconds(); }

messages::Neighbourhood MpiBackend::neighbourhood() {
  check(rank_ != host(), "the host is not one of a machine's nodes");
  return neighbourhood_;
}

void MpiBackend::meet_neighbours() {
  MPI_Request request = MPI_REQUEST_NULL;
  succeed(MPI_Ibarrier(machine_, &request), "MPI_Ibarrier");
  wait(request);
}

// MPI takes the memory without asking whether it is there, and using it would end in a bus error.
void MpiBackend::check_shared_space(std::size_t bytes) {
  struct statvfs space = {};
  std::uint64_t free_bytes = UINT64_MAX;
  if (neighbourhood_.count > 1 && statvfs("/dev/shm", &space) == 0) free_bytes = space.f_bavail * space.f_frsize;
  succeed(MPI_Bcast(&free_bytes, 1, MPI_UINT64_T, 0, machine_), "MPI_Bcast");
  if (bytes <= free_bytes) return;
  throw Failure("the nodes of a machine cannot share " + std::to_string(bytes) + " bytes: /dev/shm has " +
                    std::to_string(free_bytes) + " left",
                "node " + std::to_string(rank_),
                "enlarge /dev/shm (mount -o remount,size=..., or a container's --shm-size), or empty it");
}

std::shared_ptr<std::byte> MpiBackend::share(std::size_t bytes) {
  check(rank_ != host(), "the host takes no part in shared memory");
  meet_neighbours();
  const std::size_t whole = bytes + kAlignment;
  check_shared_space(whole);
  MPI_Win window = MPI_WIN_NULL;
  void* block = nullptr;
  const bool leads = neighbourhood_.index == 0;
  succeed(
      MPI_Win_allocate_shared(leads ? static_cast<MPI_Aint>(whole) : 0, 1, MPI_INFO_NULL, machine_, &block, &window),
      "MPI_Win_allocate_shared");
  MPI_Aint size = 0;
  int unit = 0;
  succeed(MPI_Win_shared_query(window, 0, &size, &unit, &block), "MPI_Win_shared_query");
  // Windows are mapped at pages, so every node skips the same few bytes.
  std::size_t left = whole;
  std::align(kAlignment, bytes, block, left);
  meet_neighbours();
  return {static_cast<std::byte*>(block), [this, window](std::byte*) { release_window(window); }};
}

// On the way out of a failure the neighbours may never come to a collective call: the job's end frees all.
void MpiBackend::release_window(MPI_Win window) {
  if (std::uncaught_exceptions() > 0) return;
  meet_neighbours();
  succeed(MPI_Win_free(&window), "MPI_Win_free");
}

bool MpiBackend::finish() {
  switch (ending_) {
    case Ending::not_yet:
      succeed(MPI_Ireduce_scatter_block(sent_to_.data(), &expected_, 1, MPI_INT64_T, MPI_SUM, all_, &ending_request_),
              "MPI_Ireduce_scatter_block");
      ending_ = Ending::counting;
      return false;
    case Ending::counting:
      reclaim_some();
      if (ending_request_ != MPI_REQUEST_NULL && !test(ending_request_)) return false;
      if (taken_ < static_cast<std::uint64_t>(expected_) || !pending_.empty()) return false;
      succeed(MPI_Ibarrier(all_, &ending_request_), "MPI_Ibarrier");
      ending_ = Ending::leaving;
      return false;
    case Ending::leaving:
      if (!test(ending_request_)) return false;
      ending_ = Ending::ended;
      return true;
    case Ending::ended: return true;
  }
  return true;
}

void MpiBackend::abort(const std::string& reason) { abort_job(reason); }

}  // namespace mars::mpi
