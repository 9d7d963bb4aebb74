#include "hal/mpi/mpi_backend.h"

#include <sched.h>
#include <sys/statvfs.h>

#include <algorithm>
#include <climits>
#include <cstring>
#include <exception>
#include <string>

#include "hal/failure.h"
#include "hal/message_types.h"
#include "hal/mpi/mpi_call.h"
#include "hal/mpi/patience.h"
#include "topology/machine.h"
#include "topology/placement.h"

namespace mars::hal {
namespace {

constexpr std::size_t kAlignment = 64;

// Every few calls look at as many of the copies on their way: all are seen soon, at a small price each.
constexpr std::size_t kReclaimAtOnce = 4;

constexpr std::size_t kUsuallyPending = 1024;

constexpr std::chrono::microseconds kLongestBlindSleep{1000};

// Bytes from which on a message may not be gone before it is received.
constexpr std::size_t kLong = 4096;

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

// MPI tells it of MPI_COMM_WORLD only.
int highest_tag() {
  int* highest = nullptr;
  int known = 0;
  succeed(MPI_Comm_get_attr(MPI_COMM_WORLD, MPI_TAG_UB, &highest, &known), "MPI_Comm_get_attr");
  return known ? *highest : 32767;
}

MPI_Comm split_by_machine(MPI_Comm comm, int key) {
  MPI_Comm machine = MPI_COMM_NULL;
  succeed(MPI_Comm_split_type(comm, MPI_COMM_TYPE_SHARED, key, MPI_INFO_NULL, &machine),
          "MPI_Comm_split_type");
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
  succeed(MPI_Allgather(&mine, sizeof mine, MPI_BYTE, spots.data(), sizeof mine, MPI_BYTE, ranks),
          "MPI_Allgather");
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

  MPI_Comm nodes = MPI_COMM_NULL;
  succeed(MPI_Comm_split(all_, rank_ == host() ? MPI_UNDEFINED : 0, rank_, &nodes), "MPI_Comm_split");
  if (nodes == MPI_COMM_NULL) return;
  machine_ = split_by_machine(nodes, rank_);
  succeed(MPI_Comm_free(&nodes), "MPI_Comm_free");
  const Affinity given = affinity(machine_);
  neighbourhood_ = {rank_, rank_in(machine_), size_of(machine_), rank_in(MPI_COMM_WORLD),
                    !CPU_EQUAL(&given.some, &given.every)};
  succeed(MPI_Bcast(&neighbourhood_.machine, 1, MPI_INT, 0, machine_), "MPI_Bcast");
}

MpiBackend::~MpiBackend() {
  if (ending_ != Ending::ended) return;
  bells_->take_down();
  if (machine_ != MPI_COMM_NULL) MPI_Comm_free(&machine_);
  MPI_Comm_free(&all_);
}

// An MPI need not have tags as large as types are. Internal types have the highest but one that it has; others
// that are too large for it have the highest, and travel behind their message's bytes.
int MpiBackend::tag(int type) const {
  if (type_class(type) == TypeClass::reserved) return last_tag_ + 1 + (type - kFirstInternalType);
  return type <= last_tag_ ? type : wide_tag_;
}

int MpiBackend::type(int tag) const {
  return tag <= last_tag_ ? tag : kFirstInternalType + (tag - last_tag_ - 1);
}

MPI_Request MpiBackend::isend(int to, int type, const void* data, std::size_t length) {
  if (length > INT_MAX) {
    throw Failure("a message of " + std::to_string(length) + " bytes is longer than MPI carries", "",
                  "send at most 2147483647 bytes at once");
  }
  MPI_Request request = MPI_REQUEST_NULL;
  succeed(MPI_Isend(data, static_cast<int>(length), MPI_BYTE, to, tag(type), all_, &request),
          "MPI_Isend");
  ++sent_to_[to];
  bells_->ring(to);
  return request;
}

bool MpiBackend::test(MPI_Request& request) {
  int done = 0;
  heard_ = bells_->rung();
  succeed(MPI_Test(&request, &done, MPI_STATUS_IGNORE), "MPI_Test");
  return done != 0;
}

void MpiBackend::wait(MPI_Request& request) {
  for (int turn = 0; !test(request); ++turn) idle(turn, kLongestBlindSleep);
}

void MpiBackend::send(int to, int type, const void* data, std::size_t length) {
  reclaim_some();
  Message* message = tag(type) == wide_tag_ ? with_type(type, data, length) : pool_.copy({rank_, type, length}, data);
  MPI_Request request = isend(to, type, message->bytes(), message->envelope.length);
  if (test(request)) {
    pool_.release(message);
  } else {
    pending_.push_back({request, message});
  }
}

Message* MpiBackend::with_type(std::int32_t type, const void* data, std::size_t length) {
  Message* message = pool_.acquire({rank_, type, length + sizeof type});
  if (length > 0) std::memcpy(message->bytes(), data, length);
  std::memcpy(message->bytes() + length, &type, sizeof type);
  return message;
}

bool MpiBackend::all_sent() {
  return pending_.empty() && std::all_of(tickets_.begin(), tickets_.end(),
                                         [this](MPI_Request& request) { return test(request); });
}

void MpiBackend::reclaim_some() {
  for (std::size_t looks = std::min(kReclaimAtOnce, pending_.size()); looks > 0; --looks) {
    if (next_pending_ >= pending_.size()) next_pending_ = 0;
    if (!test(pending_[next_pending_].request)) {
      ++next_pending_;
      continue;
    }
    pool_.release(pending_[next_pending_].message);
    pending_[next_pending_] = pending_.back();
    pending_.pop_back();
    if (pending_.empty()) return;
  }
}

Ticket MpiBackend::start_send(int to, int type, const void* data, std::size_t length) {
  MPI_Request request = MPI_REQUEST_NULL;
  if (tag(type) == wide_tag_)
    send(to, type, data, length);
  else
    request = isend(to, type, data, length);
  if (free_tickets_.empty()) {
    free_tickets_.push_back(static_cast<Ticket>(tickets_.size()));
    tickets_.push_back(MPI_REQUEST_NULL);
    free_tickets_.reserve(tickets_.size());
  }
  const Ticket ticket = free_tickets_.back();
  free_tickets_.pop_back();
  tickets_[ticket] = request;
  return ticket;
}

bool MpiBackend::sent(Ticket ticket) {
  if (!test(tickets_[ticket])) return false;
  free_tickets_.push_back(ticket);
  return true;
}

std::optional<Envelope> MpiBackend::peek() {
  reclaim_some();
  if (peeked_) return peeked_;
  heard_ = bells_->rung();
  int arrived = 0;
  MPI_Status status;
  // Open MPI's first look may only fetch what has come, and the second one sees it: whoever slept on the first
  // would not be rung again.
  for (int looks = 0; looks < 2 && arrived == 0; ++looks)
    succeed(MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, all_, &arrived, &status), "MPI_Iprobe");
  if (arrived == 0) return std::nullopt;
  int length = 0;
  succeed(MPI_Get_count(&status, MPI_BYTE, &length), "MPI_Get_count");
  peeked_ = Envelope{status.MPI_SOURCE, type(status.MPI_TAG), static_cast<std::size_t>(length)};
  if (status.MPI_TAG == wide_tag_) peeked_ = open_wide(*peeked_);
  return peeked_;
}

Envelope MpiBackend::open_wide(const Envelope& whole) {
  opened_ = pool_.acquire(whole);
  receive(opened_->bytes(), whole, wide_tag_);
  std::int32_t type = 0;
  const std::size_t length = whole.length - sizeof type;
  std::memcpy(&type, opened_->bytes() + length, sizeof type);
  return {whole.from, type, length};
}

void MpiBackend::receive(void* buffer, const Envelope& envelope, int tag) {
  MPI_Request request = MPI_REQUEST_NULL;
  succeed(MPI_Irecv(buffer, static_cast<int>(envelope.length), MPI_BYTE, envelope.from, tag, all_, &request),
          "MPI_Irecv");
  wait(request);
  // Its sender may be waiting for just that; of a short one it does not.
  if (envelope.length >= kLong) bells_->ring(envelope.from);
}

void MpiBackend::take(void* buffer) {
  if (opened_ == nullptr) {
    receive(buffer, *peeked_, tag(peeked_->type));
  } else {
    if (peeked_->length > 0) std::memcpy(buffer, opened_->bytes(), peeked_->length);
    pool_.release(opened_);
    opened_ = nullptr;
  }
  peeked_.reset();
  ++taken_;
}

// Of what ranks send that have no bell here, and of what MPI still has to do for a send, only a look tells.
void MpiBackend::idle(int turn, std::chrono::microseconds longest) {
  const auto pause = pause_of(turn, oversubscribed_);
  if (!pause) return;
  const std::uint32_t heard = heard_;  // all_sent looks at less than who waits has looked at
  if (pause->count() == 0)
    sched_yield();
  else if (*pause < kLongestBlindSleep || (bells_->everyone_has_one() && all_sent()))
    bells_->sleep(heard, std::min(*pause, longest));
  else
    bells_->sleep(heard, std::min(kLongestBlindSleep, longest));
}

Neighbourhood MpiBackend::neighbourhood() {
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
  if (neighbourhood_.count > 1 && statvfs("/dev/shm", &space) == 0)
    free_bytes = space.f_bavail * space.f_frsize;
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
  const std::size_t room = bytes + kAlignment;
  check_shared_space(room);
  MPI_Win window = MPI_WIN_NULL;
  void* block = nullptr;
  const bool leads = neighbourhood_.index == 0;
  succeed(MPI_Win_allocate_shared(leads ? static_cast<MPI_Aint>(room) : 0, 1, MPI_INFO_NULL, machine_, &block,
                                  &window),
          "MPI_Win_allocate_shared");
  MPI_Aint size = 0;
  int unit = 0;
  succeed(MPI_Win_shared_query(window, 0, &size, &unit, &block), "MPI_Win_shared_query");
  // Windows are mapped at pages, so every node skips the same few bytes.
  std::size_t left = room;
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
      succeed(MPI_Ireduce_scatter_block(sent_to_.data(), &expected_, 1, MPI_INT64_T, MPI_SUM, all_,
                                        &ending_request_),
              "MPI_Ireduce_scatter_block");
      ending_ = Ending::counting;
      return false;
    case Ending::counting:
      reclaim_some();
      if (ending_request_ != MPI_REQUEST_NULL && !test(ending_request_)) return false;
      if (taken_ < expected_ || !pending_.empty()) return false;
      succeed(MPI_Ibarrier(all_, &ending_request_), "MPI_Ibarrier");
      ending_ = Ending::leaving;
      return false;
    case Ending::leaving:
      if (!test(ending_request_)) return false;
      ending_ = Ending::ended;
      return true;
    case Ending::ended:
      return true;
  }
  return true;
}

void MpiBackend::abort(const std::string& reason) { abort_job(reason); }

}  // namespace mars::hal
