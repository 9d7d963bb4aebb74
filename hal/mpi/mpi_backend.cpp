#include "hal/mpi/mpi_backend.h"

#include <sched.h>

#include <algorithm>
#include <array>
#include <climits>

#include "hal/failure/failure.h"
#include "hal/messages/memory_file.h"
#include "hal/messages/message_types.h"
#include "hal/messages/pages.h"
#include "hal/mpi/mpi_call.h"
#include "hal/mpi/patience.h"
#include "topology/machine.h"
#include "topology/placement.h"

namespace mars::mpi {
namespace {

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

// By rank in `all`, whether it is in `some` too.
std::vector<bool> members(MPI_Comm some, MPI_Comm all) {
  std::vector<int> ranks(static_cast<std::size_t>(size_of(some)));
  const int mine = rank_in(all);
  succeed(MPI_Allgather(&mine, 1, MPI_INT, ranks.data(), 1, MPI_INT, some), "MPI_Allgather");
  std::vector<bool> are(static_cast<std::size_t>(size_of(all)));
  for (const int rank : ranks) are[static_cast<std::size_t>(rank)] = true;
  return are;
}

// The first of all ranks' texts that is not empty, the same on all; long ones lose their end.
std::string first_text(const std::string& mine, MPI_Comm comm) {
  using Text = std::array<char, 200>;
  Text text{};
  mine.copy(text.data(), text.size() - 1);
  std::vector<Text> texts(static_cast<std::size_t>(size_of(comm)));
  succeed(MPI_Allgather(&text, sizeof text, MPI_BYTE, texts.data(), sizeof text, MPI_BYTE, comm), "MPI_Allgather");
  const auto found = std::find_if(texts.begin(), texts.end(), [](const Text& each) { return each[0] != 0; });
  return found == texts.end() ? "" : found->data();
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
  is_here_ = members(ranks_here, all_);
  bells_.emplace(ranks_here, all_);
  succeed(MPI_Comm_free(&ranks_here), "MPI_Comm_free");

  succeed(MPI_Comm_split(all_, rank_ == host() ? MPI_UNDEFINED : 0, rank_, &nodes_only_), "MPI_Comm_split");
  if (nodes_only_ == MPI_COMM_NULL) return;
  machine_ = split_by_machine(nodes_only_, rank_);
  const Affinity given = affinity(machine_);
  neighbourhood_ = {rank_, rank_in(machine_), size_of(machine_), rank_in(MPI_COMM_WORLD),
                    !CPU_EQUAL(&given.some, &given.every)};
  succeed(MPI_Bcast(&neighbourhood_.machine, 1, MPI_INT, 0, machine_), "MPI_Bcast");
  find_out_whether_memory_is_shared();
}

void MpiBackend::find_out_whether_memory_is_shared() {
  std::string refusal;
  if (neighbourhood_.count == 1 || share_offered(1, refusal) != nullptr) return;
  neighbourhood_.refusal = first_text(refusal, machine_);
}

MpiBackend::~MpiBackend() {
  if (ending_ != Ending::ended) return;
  bells_->take_down();
  if (machine_ != MPI_COMM_NULL) MPI_Comm_free(&machine_);
  if (nodes_only_ != MPI_COMM_NULL) MPI_Comm_free(&nodes_only_);
  MPI_Comm_free(&all_);
}

double MpiBackend::seconds() const { return mpi_waits_well() ? MPI_Wtime() : messages::machine_seconds(); }

bool MpiBackend::has_machine_clock() const { return !mpi_waits_well(); }

messages::Neighbourhood MpiBackend::neighbourhood() {
  check(rank_ != host(), "the host is not one of a machine's nodes");
  return neighbourhood_;
}

// The first node offers it and the others attach it; nullptr on all where one of them cannot have it.
std::shared_ptr<std::byte> MpiBackend::share_offered(std::size_t bytes, std::string& refusal) {
  const bool leads = neighbourhood_.index == 0;
  messages::Offer offer;
  if (leads) offer = messages::offer_file(rank_, bytes, refusal);
  MPI_Request request = MPI_REQUEST_NULL;
  succeed(MPI_Ibcast(&offer.name, sizeof offer.name, MPI_BYTE, 0, machine_, &request), "MPI_Ibcast");
  wait_for_others(request);
  if (!leads) offer.block = messages::attach_file(neighbourhood_.machine, offer.name, bytes, refusal);
  const int mine = offer.block != nullptr;
  int all = 0;
  succeed(MPI_Iallreduce(&mine, &all, 1, MPI_INT, MPI_MIN, machine_, &request), "MPI_Iallreduce");
  wait_for_others(request);
  return all != 0 ? offer.block : nullptr;
}

std::shared_ptr<std::byte> MpiBackend::share(std::size_t bytes) {
  check(rank_ != host(), "the host takes no part in shared memory");
  const bool alone = neighbourhood_.count == 1 || !neighbourhood_.refusal.empty();
  std::string refusal;
  std::shared_ptr<std::byte> block = alone ? messages::map_pages(bytes) : share_offered(bytes, refusal);
  if (block == nullptr) throw messages::too_much_to_share(bytes, "node " + std::to_string(rank_));
  return block;
}

messages::Offer MpiBackend::offer(std::size_t bytes) {
  std::string refusal;
  return messages::offer_file(rank_, bytes, refusal);
}

std::shared_ptr<std::byte> MpiBackend::attach(int rank, const messages::MemoryName& name, std::size_t bytes) {
  if (rank < 0 || rank > nodes_ || !is_here_[static_cast<std::size_t>(rank)]) return nullptr;
  std::string refusal;
  return messages::attach_file(rank, name, bytes, refusal);
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
      if (taken_ < static_cast<std::uint64_t>(expected_) || !nothing_under_way()) return false;
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
