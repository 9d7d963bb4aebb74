// Bells of ranks that SimGrid simulates: they are all in one process, whatever machines they are taken to be on, and
// sleep in simulated time.
#include "hal/mpi/bells.h"

#include <chrono>
#include <cstddef>
#include <cstdint>

#include <simgrid/semaphore.h>

#include "hal/mpi/mpi_call.h"

namespace mars::mpi {

// One rank runs at a time, and gives way to others in calls of SimGrid and MPI only.
struct Bells::Bell {
  bool armed = false;
  bool sleeps = false;
  sg_sem_t wake = sg_sem_init(0);
};

Bells::Bells(MPI_Comm, MPI_Comm all) : mine_(new Bell), everyone_(true), of_(size_of(all)) {
  succeed(MPI_Allgather(&mine_, sizeof mine_, MPI_BYTE, of_.data(), sizeof mine_, MPI_BYTE, all), "MPI_Allgather");
}

void Bells::ring(int id) {
  Bell* bell = of_[static_cast<std::size_t>(id)];
  bell->armed = false;
  if (!bell->sleeps) return;
  bell->sleeps = false;
  sg_sem_release(bell->wake);
}

void Bells::arm() { mine_->armed = true; }

bool Bells::armed() const { return mine_->armed; }

void Bells::sleep(std::chrono::microseconds longest) {
  if (!mine_->armed) return;
  mine_->sleeps = true;
  sg_sem_acquire_timeout(mine_->wake, std::chrono::duration<double>(longest).count());
  mine_->sleeps = false;
}

// A copy takes no simulated time: there is nothing to spare.
void Bells::await(std::int32_t) {}

bool Bells::claim(int, std::int32_t) { return false; }

void Bells::take_down() {
  sg_sem_destroy(mine_->wake);
  delete mine_;
}

}  // namespace mars::mpi
