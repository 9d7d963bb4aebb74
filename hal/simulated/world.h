// The simulated job: ranks that run one at a time, each with a clock of its own; the rank whose clock is least runs.
// A rank runs on until it sends, looks for messages, waits or works on a processor that it shares: then ranks that are
// behind catch up first, so that everything that ranks have in common happens in the order of simulated time, and every
// run of a program gives the same times. Among equal times the lower rank is first.
//
// Ranks that wait for each other alone (keep_to) are a community: it runs ahead of others until its ranks all wait, so
// that few communities hold the memory of work in hand. Within it, time's order holds, also for those of its ranks that
// have yet to hear of their common work. Others meet it at the host, which waits until all have come to
// its time, and in the network, where a message takes the first free stretch whenever it is given.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "hal/messages/backend.h"
#include "hal/messages/message_pool.h"
#include "hal/simulated/computers.h"
#include "hal/simulated/machine.h"
#include "hal/simulated/routes.h"
#include "hal/simulated/storage_use.h"
#include "hal/simulated/turn.h"

namespace mars::simulated {

class World {
 public:
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  World(const Machine& machine, int nodes);

  int nodes() const { return nodes_; }
  int computer_of(int rank) const { return computers_.of(rank); }
  int nodes_on(int computer) const { return computers_.nodes_on(computer); }
  const Machine& machine() const { return machine_; }

  // Of the running rank.

  double clock(int rank) const { return ranks_[rank]->clock; }
  void keep_to(int rank, int first, int count);
  // Work on one of the computer's processors, when one is free.
  void work(int rank, double seconds);
  void send(int from, int to, int type, const void* data, std::size_t length);
  // The first message that has arrived, in the order of arrival.
  std::optional<messages::Envelope> peek(int rank);
  // What peek returned. Waits for the rest of an announced message.
  void take(int rank, void* buffer);
  struct Taken {
    int type;
    std::size_t length;
    double there;  // when all of it is
  };
  // The same without waiting. When all is there, end_take is due.
  Taken begin_take(int rank, void* buffer);
  void end_take(int rank, const Taken& taken);
  // Until a message comes that neither peek nor a wait has seen yet, an alarm, or `seconds` have passed.
  void wait(int rank, double seconds);
  // The rank will not wait beyond `time`.
  void set_alarm(int rank, double time);
  // Work of others than ranks on a processor of the rank's computer, from now on: when it will be done.
  double reserve(int rank, double seconds);
  // A file of `bytes`, which goes to storage from then on: when it is there.
  double store(int rank, double begin, double bytes);

  // Throws the failure that stopped the world.
  void check_running() const;
  void stop(std::exception_ptr reason);
  std::exception_ptr failure() const { return failure_; }
  // Counts a rank that has come to its end; true when all have.
  void finish_one();
  bool finished() const { return finished_ == static_cast<int>(ranks_.size()); }

  // Memory.

  std::shared_ptr<std::byte> share(int rank, int index, std::size_t bytes);
  std::shared_ptr<std::byte> replica(std::uint64_t key, std::size_t bytes);
  messages::MessagePool& pool() { return pool_; }
  messages::Offer offer(int rank, std::size_t bytes);
  std::shared_ptr<std::byte> attach(int rank, int offerer, const messages::MemoryName& name);

  // Turns, for the threads of ranks.

  void await_first_turn(int rank) { ranks_[rank]->turn.acquire(); }
  // The rank runs no more; another gets the turn.
  void end(int rank);
  // A rank that never began.
  void leave_out(int rank);

 private:
  using Queue = std::set<std::pair<double, int>>;  // due, rank
  struct Message {
    double arrival;
    std::uint64_t number;  // among all
    messages::Message* message;
    bool announced;  // only that: its bytes begin to move when it is taken
  };
  struct Later {
    bool operator()(const Message& a, const Message& b) const {
      return std::pair(a.arrival, a.number) > std::pair(b.arrival, b.number);
    }
  };
  struct Rank {
    double clock = 0;
    double due = 0;      // when it goes on, where another runs
    bool waits = false;  // for messages
    bool timed = false;  // but not for ever
    bool ended = false;
    std::vector<Message> coming;  // a heap, the earliest arrival first
    std::deque<Message> arrived;  // and noted
    std::multiset<double> alarms;
    Queue* community = nullptr;  // with all ranks of its group that are due; none: it is of no group
    bool runs_ahead = false;     // with the community
    Turn turn;
  };
  struct Block {
    std::shared_ptr<std::byte> bytes;
    std::size_t size;
    int holders;
  };
  struct Offered {
    std::weak_ptr<std::byte> offer;  // expires when its rank lets go
    std::weak_ptr<std::byte> bytes;  // when all have
  };

  static void note_arrivals(Rank& self);
  const Queue& others_of(const Rank& self) const { return self.runs_ahead ? *self.community : queue_; }
  void let_earlier_run(int rank);
  void pass_turn(int rank);
  int next_rank(const Rank& last);
  int first_after(const Rank& last) const;
  void set_due(int rank, double due);
  void join(int rank, Queue& community);
  void drop(int rank);
  double floor_at(double now) const;
  double seconds_of(const std::vector<EndCost>& costs, std::size_t length) const;
  double end_seconds(int rank, const std::vector<EndCost>& costs, std::size_t length) const;

  const Machine machine_;
  const int nodes_;
  Computers computers_;
  Routes routes_;
  StorageUse storage_;
  messages::MessagePool pool_;  // of messages on their way, and all ranks'
  std::vector<std::unique_ptr<Rank>> ranks_;
  Queue queue_;                       // all that neither run nor wait for ever
  std::map<int, Queue> communities_;  // communities by their first rank
  const bool ordered_;                // ranks share what they must use in the order of time
  std::uint64_t messages_ = 0;        // sent so far
  int finished_ = 0;
  int left_;  // that have not ended
  std::exception_ptr failure_;
  std::map<std::pair<int, int>, Block> blocks_;  // by computer and number
  std::map<std::uint64_t, std::weak_ptr<std::byte>> replicas_;
  std::map<std::uint64_t, Offered> offered_;
  std::uint64_t offers_ = 0;
};

}  // namespace mars::simulated
