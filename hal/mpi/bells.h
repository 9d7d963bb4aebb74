// A bell for each rank of a machine, in memory that they share: who sends to a rank rings its bell, so that it
// can sleep while nothing comes and still wake at once. MPI itself offers no way to sleep. Ranks on other
// machines have none here: their messages are noticed when a sleep ends by itself.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <vector>

#include <mpi.h>

namespace mars::hal {

class Bells {
 public:
  // Collective over `here`, the ranks of this machine; their ids are their ranks in `all`.
  Bells(MPI_Comm here, MPI_Comm all);
  Bells(const Bells&) = delete;
  Bells& operator=(const Bells&) = delete;

  // All ranks are on this machine.
  bool everyone_has_one() const { return everyone_; }
  // Wakes rank `id` if it is on this machine.
  void ring(int id);
  // How often this rank's bell has been rung: taken before looking for messages, given to `sleep` after.
  std::uint32_t rung() const;
  // Until this rank's bell has been rung more often than `before`, at most so long.
  void sleep(std::uint32_t before, std::chrono::microseconds longest);

  // Collective, once nobody rings any more. Not in the destructor: after a failure others may never come.
  void take_down();

 private:
  struct alignas(64) Bell {
    std::atomic<std::uint32_t> rung;
    std::atomic<std::uint32_t> sleeper;  // 1: its rank may be asleep
  };

  MPI_Win window_ = MPI_WIN_NULL;
  Bell* bells_ = nullptr;   // by rank in `here`
  Bell* mine_ = nullptr;
  bool everyone_ = false;
  std::vector<Bell*> of_;   // by id; null: on another machine
};

}  // namespace mars::hal
