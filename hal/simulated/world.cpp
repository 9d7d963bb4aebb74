#include "hal/simulated/world.h"

#include <algorithm>
#include <cstring>

#include "hal/failure/failure.h"
#include "hal/messages/pages.h"

namespace mars::simulated {
namespace {

// Processors that ranks share, and channels that a message holds all at once, must be used in the order of time.
bool must_be_ordered(const Machine& machine, const Computers& computers) {
  return machine.network.topology == Topology::hypercube || computers.any_crowded();
}

}  // namespace

World::World(const Machine& machine, int nodes)
    : machine_(machine),
      nodes_(nodes),
      computers_(machine_, nodes),
      routes_(machine.network, computers_.count(), computers_.of(nodes)),
      storage_(machine.storage, machine.network),
      ordered_(must_be_ordered(machine, computers_)),
      left_(nodes + 1) {
  check(nodes >= 1 && machine.nodes >= 1 && machine.processors >= 1, "there are a node and a processor");
  for (int rank = 0; rank <= nodes; ++rank) {
    ranks_.push_back(std::make_unique<Rank>());
    if (rank < nodes) queue_.emplace(0, rank);
  }
}

void World::work(int rank, double seconds) {
  if (computers_.crowded(computer_of(rank))) let_earlier_run(rank);
  Rank& self = *ranks_[rank];
  self.clock = computers_.work(rank, self.clock, seconds);
}

double World::reserve(int rank, double seconds) {
  let_earlier_run(rank);
  return computers_.reserve(rank, clock(rank), seconds);
}

double World::store(int rank, double begin, double bytes) {
  let_earlier_run(rank);
  return storage_.write(computer_of(rank), begin, bytes, floor_at(clock(rank)));
}

double World::seconds_of(const std::vector<EndCost>& costs, std::size_t length) const {
  double seconds = 0;
  for (const EndCost& cost : costs)
    if (length >= cost.from) seconds = cost.seconds;
  return seconds + machine_.network.copy_byte * static_cast<double>(length);
}

double World::end_seconds(int rank, const std::vector<EndCost>& costs, std::size_t length) const {
  const bool as_host = rank == nodes_ && !machine_.network.host_end.empty();
  return seconds_of(as_host ? machine_.network.host_end : costs, length);
}

void World::send(int from, int to, int type, const void* data, std::size_t length) {
  check_running();
  const bool takes_time = machine_.network.takes_time(type);
  if (takes_time) work(from, end_seconds(from, machine_.network.send, length));
  let_earlier_run(from);
  const double now = clock(from);
  const int here = computer_of(from), there = computer_of(to);
  const bool announced = takes_time && routes_.announces(here, there, length);
  const bool travels = takes_time && from != to;
  const double arrival = travels ? routes_.arrival(here, there, announced ? 0 : length, now, floor_at(now)) : now;
  Rank& receiver = *ranks_[to];
  receiver.coming.push_back({arrival, messages_++, pool_.copy({from, type, length}, data), announced});
  std::ranges::push_heap(receiver.coming, Later());
  if (receiver.waits && arrival < receiver.due) set_due(to, std::max(arrival, receiver.clock));
}

void World::note_arrivals(Rank& self) {
  while (!self.coming.empty() && self.coming.front().arrival <= self.clock) {
    std::ranges::pop_heap(self.coming, Later());
    self.arrived.push_back(self.coming.back());
    self.coming.pop_back();
  }
}

std::optional<messages::Envelope> World::peek(int rank) {
  let_earlier_run(rank);
  check_running();
  Rank& self = *ranks_[rank];
  note_arrivals(self);
  if (self.arrived.empty()) return std::nullopt;
  return self.arrived.front().message->envelope;
}

void World::take(int rank, void* buffer) {
  const Taken taken = begin_take(rank, buffer);
  Rank& self = *ranks_[rank];
  self.clock = std::max(self.clock, taken.there);
  end_take(rank, taken);
}

// The receiver answers an announcement here, in a call, as where MPI's progress is in its calls alone; the sender's
// adapter then sends the bytes whatever its processor does.
World::Taken World::begin_take(int rank, void* buffer) {
  Rank& self = *ranks_[rank];
  if (self.arrived.front().announced) let_earlier_run(rank);
  const auto [arrival, number, message, announced] = self.arrived.front();
  self.arrived.pop_front();
  const auto [from, type, length] = message->envelope;
  if (length > 0) std::memcpy(buffer, message->bytes(), length);
  pool_.release(message);
  if (!announced) return {type, length, self.clock};
  const double now = self.clock;
  return {type, length, routes_.rest_arrival(computer_of(from), computer_of(rank), length, now, floor_at(now))};
}

void World::end_take(int rank, const Taken& taken) {
  const Network& network = machine_.network;
  if (network.takes_time(taken.type)) work(rank, end_seconds(rank, network.receive, taken.length));
}

void World::set_alarm(int rank, double time) {
  Rank& other = *ranks_[rank];
  other.alarms.insert(time);
  if (other.waits && time < other.due) set_due(rank, std::max(time, other.clock));
}

void World::wait(int rank, double seconds) {
  check_running();
  Rank& self = *ranks_[rank];
  double until = self.clock + seconds;
  self.timed = until < kNever;
  if (!self.coming.empty()) until = std::min(until, self.coming.front().arrival);
  if (!self.alarms.empty()) until = std::min(until, *self.alarms.begin());
  self.waits = true;
  set_due(rank, std::max(until, self.clock));
  pass_turn(rank);
  self.waits = false;
  note_arrivals(self);
  self.alarms.erase(self.alarms.begin(), self.alarms.upper_bound(self.clock));
  check_running();
}

void World::let_earlier_run(int rank) {
  const Rank& self = *ranks_[rank];
  const Queue& others = others_of(self);
  if (others.empty() || *others.begin() > std::pair(self.clock, rank)) return;
  set_due(rank, self.clock);
  pass_turn(rank);
}

void World::set_due(int rank, double due) {
  Rank& self = *ranks_[rank];
  drop(rank);
  self.due = due;
  if (due == kNever) return;
  queue_.emplace(due, rank);
  if (self.community != nullptr) self.community->emplace(due, rank);
}

void World::drop(int rank) {
  const Rank& self = *ranks_[rank];
  queue_.erase({self.due, rank});
  if (self.community != nullptr) self.community->erase({self.due, rank});
}

// The first of the queue goes on, which may be the caller itself.
void World::pass_turn(int rank) {
  const int next = next_rank(*ranks_[rank]);
  if (next != rank) {
    ranks_[next]->turn.release();
    ranks_[rank]->turn.acquire();
  }
  Rank& self = *ranks_[rank];
  self.clock = std::max(self.clock, self.due);
}

int World::next_rank(const Rank& last) {
  if (queue_.empty()) {
    stop(std::make_exception_ptr(Failure("all ranks wait, and no message is on its way", "",
                                         "find the message that is missing; see docs/nx.md on strict mode")));
  }
  const int next = first_after(last);
  drop(next);
  return next;
}

// Of the last one's community, unless that has only ranks that let time pass: this may take others.
int World::first_after(const Rank& last) const {
  const Queue& community = others_of(last);
  const bool ahead = !community.empty() && !ranks_[community.begin()->second]->timed;
  return (ahead ? community : queue_).begin()->second;
}

// Nothing that begins now will have been given an earlier time.
double World::floor_at(double now) const { return queue_.empty() ? now : std::min(now, queue_.begin()->first); }

void World::keep_to(int rank, int first, int count) {
  ranks_[rank]->runs_ahead = !ordered_ && count < nodes_;
  if (!ranks_[rank]->runs_ahead) return;
  for (int other = first; other < first + count; ++other) join(other, communities_[first]);
}

void World::join(int rank, Queue& community) {
  Rank& self = *ranks_[rank];
  if (self.community == &community) return;
  const bool is_due = queue_.contains({self.due, rank});
  drop(rank);
  self.community = &community;
  if (is_due) set_due(rank, self.due);
}

void World::end(int rank) {
  ranks_[rank]->ended = true;
  if (--left_ > 0) ranks_[next_rank(*ranks_[rank])]->turn.release();
}

void World::leave_out(int rank) {
  ranks_[rank]->ended = true;
  --left_;
  set_due(rank, kNever);
}

void World::check_running() const {
  if (failure_ != nullptr) std::rethrow_exception(failure_);
}

// All go on, to end.
void World::stop(std::exception_ptr reason) {
  if (failure_ == nullptr) failure_ = std::move(reason);
  for (int rank = 0; rank <= nodes_; ++rank)
    if (!ranks_[rank]->ended && ranks_[rank]->due == kNever) set_due(rank, ranks_[rank]->clock);
}

void World::finish_one() {
  if (++finished_ < static_cast<int>(ranks_.size())) return;
  double last = 0;
  for (const auto& rank : ranks_) last = std::max(last, rank->clock);
  for (int rank = 0; rank <= nodes_; ++rank) set_alarm(rank, last);
}

std::shared_ptr<std::byte> World::share(int rank, int index, std::size_t bytes) {
  const int computer = computer_of(rank);
  const auto [found, fresh] = blocks_.try_emplace({computer, index});
  Block& block = found->second;
  if (fresh) block = {messages::map_pages(bytes), bytes, 0};
  check(block.size == bytes, "all nodes of a machine share the same number of bytes");
  if (block.bytes == nullptr) throw messages::too_much_to_share(bytes, "");
  std::shared_ptr<std::byte> mine = block.bytes;
  if (++block.holders == nodes_on(computer)) blocks_.erase(found);
  return mine;
}

std::shared_ptr<std::byte> World::replica(std::uint64_t key, std::size_t bytes) {
  std::weak_ptr<std::byte>& known = replicas_[key];
  if (std::shared_ptr<std::byte> there = known.lock()) return there;
  std::shared_ptr<std::byte> made = messages::map_pages(bytes);
  known = made;
  return made;
}

messages::Offer World::offer(int rank, std::size_t bytes) {
  std::shared_ptr<std::byte> block = messages::map_pages(bytes);
  if (block == nullptr) return {};
  // A handle of its rank's own: the bytes may outlive it at others, but nobody attaches them any more.
  std::shared_ptr<std::byte> handle(block.get(), [block](std::byte*) mutable { block.reset(); });
  std::erase_if(offered_, [](const auto& old) { return old.second.offer.expired(); });
  const std::uint64_t number = offers_++;
  offered_[number] = {handle, block};
  return {{{number, static_cast<std::uint64_t>(rank), bytes, reinterpret_cast<std::uintptr_t>(block.get())}}, handle};
}

std::shared_ptr<std::byte> World::attach(int rank, int offerer, const messages::MemoryName& name) {
  if (computer_of(rank) != computer_of(offerer)) return nullptr;
  const auto found = offered_.find(name.words[0]);
  if (found == offered_.end() || found->second.offer.expired()) return nullptr;
  std::shared_ptr<std::byte> bytes = found->second.bytes.lock();
  const bool same = reinterpret_cast<std::uintptr_t>(bytes.get()) == name.words[3];
  return same ? bytes : nullptr;
}

}  // namespace mars::simulated
