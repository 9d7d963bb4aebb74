#include "hal/mpi/bells.h"

#include <atomic>
#include <ctime>
#include <memory>
#include <new>

#include "hal/messages/futex.h"
#include "hal/mpi/mpi_call.h"

namespace mars::mpi {

static_assert(std::atomic<std::int32_t>::is_always_lock_free, "processes share these");

struct alignas(64) Bells::Bell {
  std::atomic<std::uint32_t> armed{0};          // 1: its rank may be asleep
  std::atomic<std::int32_t> awaited{kNothing};  // type
};

Bells::Bells(MPI_Comm here, MPI_Comm all) {
  const int count = size_of(here);
  const int index = rank_in(here);
  void* block = nullptr;
  const MPI_Aint bytes = index == 0 ? static_cast<MPI_Aint>((count + 1) * sizeof(Bell)) : 0;
  succeed(MPI_Win_allocate_shared(bytes, 1, MPI_INFO_NULL, here, &block, &window_), "MPI_Win_allocate_shared");
  MPI_Aint size = 0;
  int unit = 0;
  succeed(MPI_Win_shared_query(window_, 0, &size, &unit, &block), "MPI_Win_shared_query");
  // Mapped at pages, so that every rank skips the same few bytes.
  std::size_t left = static_cast<std::size_t>(size);
  std::align(alignof(Bell), count * sizeof(Bell), block, left);
  Bell* bells = static_cast<Bell*>(block);  // by rank in `here`
  mine_ = new (bells + index) Bell{};

  std::vector<int> ids(count);
  const int id = rank_in(all);
  of_.resize(size_of(all));
  // Also makes all bells before anyone rings one.
  succeed(MPI_Allgather(&id, 1, MPI_INT, ids.data(), 1, MPI_INT, here), "MPI_Allgather");
  everyone_ = count == size_of(all);
  for (int i = 0; i < count; ++i) of_[ids[i]] = bells + i;
}

// The fence orders what was done before the look at the flag, as `arm` orders the flag before its rank's look
// at what was done: one sees the other.
void Bells::ring(int id) {
  Bell* bell = of_[static_cast<std::size_t>(id)];
  if (bell == nullptr) return;
  std::atomic_thread_fence(std::memory_order_seq_cst);
  if (bell->armed.load(std::memory_order_relaxed) == 0) return;
  if (bell->armed.exchange(0) == 1) messages::futex(bell->armed, FUTEX_WAKE, 1, nullptr);
}

void Bells::arm() {
  mine_->armed.store(1);
  std::atomic_thread_fence(std::memory_order_seq_cst);
}

bool Bells::armed() const { return mine_->armed.load(std::memory_order_relaxed) == 1; }

void Bells::sleep(std::chrono::microseconds longest) {
  const timespec timeout{0, static_cast<long>(std::chrono::nanoseconds(longest).count())};
  messages::futex(mine_->armed, FUTEX_WAIT, 1, &timeout);
}

void Bells::await(std::int32_t type) {
  if (mine_->awaited.load(std::memory_order_relaxed) != type) mine_->awaited.store(type, std::memory_order_relaxed);
}

bool Bells::claim(int id, std::int32_t type) {
  Bell* bell = of_[static_cast<std::size_t>(id)];
  if (bell == nullptr || bell->awaited.load(std::memory_order_relaxed) != type) return false;
  return bell->awaited.compare_exchange_strong(type, kNothing);
}

void Bells::take_down() { MPI_Win_free(&window_); }

}  // namespace mars::mpi
