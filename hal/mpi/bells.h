// A bell for each rank of a machine, in memory that they share: a sender rings the receiver's bell, so
// that a rank can sleep while nothing comes and still wake at once. MPI itself offers no way to sleep. Ranks on other
// machines have none here: their messages are noticed when a sleep ends by itself. Ringing costs next to
// nothing while nobody sleeps: a rank arms its bell, looks once more, and only then sleeps; senders only look
// whether a bell is armed, in a line of memory that seldom changes.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <mpi.h>

namespace mars::mpi {

class Bells {
 public:
  // Collective over `here`, the ranks of this machine; their ids are their ranks in `all`.
  Bells(MPI_Comm here, MPI_Comm all);
  Bells(const Bells&) = delete;
  Bells& operator=(const Bells&) = delete;

  // All ranks are on this machine.
  bool everyone_has_one() const { return everyone_; }
  // Rank `id` is on this machine.
  bool reaches(int id) const {
    return static_cast<std::size_t>(id) < of_.size() && of_[static_cast<std::size_t>(id)] != nullptr;
  }

  // Wakes rank `id` if it sleeps on this machine: to be called after what it may wait for has been done.
  void ring(int id);
  // Once armed, a bell is armed until it rings.
  void arm();
  bool armed() const;
  // Until this rank's bell rings, at most so long; not at all if it rang since it was armed. The caller
  // has looked since it armed the bell.
  void sleep(std::chrono::microseconds longest);

  // Says that this rank waits for a message of `type` and nothing else; kNothing: for none.
  static constexpr std::int32_t kNothing = -1;
  void await(std::int32_t type);
  // True once for one sender, where rank `id` awaits just this type: its message is received at once.
  bool claim(int id, std::int32_t type);

  // Collective, once nobody rings any more. Not in the destructor: after a failure others may never come.
  void take_down();

 private:
  struct Bell;

  MPI_Win window_ = MPI_WIN_NULL;
  Bell* mine_ = nullptr;
  bool everyone_ = false;
  std::vector<Bell*> of_;  // by id; null: on another machine
};

}  // namespace mars::mpi
