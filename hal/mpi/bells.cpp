#include "hal/mpi/bells.h"

#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <memory>
#include <new>

#include "hal/mpi/mpi_call.h"

namespace mars::hal {
namespace {

static_assert(std::atomic<std::uint32_t>::is_always_lock_free, "processes share these");

// Not one of glibc's calls. Any of its errors means: look again.
void futex(std::atomic<std::uint32_t>& word, int operation, std::uint32_t value, const timespec* timeout) {
  syscall(SYS_futex, reinterpret_cast<std::uint32_t*>(&word), operation, value, timeout, nullptr, 0);
}

}  // namespace

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
  std::size_t room = static_cast<std::size_t>(size);
  std::align(alignof(Bell), count * sizeof(Bell), block, room);
  bells_ = static_cast<Bell*>(block);
  mine_ = new (bells_ + index) Bell{};

  std::vector<int> ids(count);
  const int id = rank_in(all);
  of_.resize(size_of(all));
  // Also makes all bells before anyone rings one.
  succeed(MPI_Allgather(&id, 1, MPI_INT, ids.data(), 1, MPI_INT, here), "MPI_Allgather");
  everyone_ = count == size_of(all);
  for (int i = 0; i < count; ++i) of_[ids[i]] = bells_ + i;
}

void Bells::ring(int id) {
  Bell* bell = of_[id];
  if (bell == nullptr) return;
  bell->rung.fetch_add(1);
  if (bell->sleeper.load() == 1) futex(bell->rung, FUTEX_WAKE, 1, nullptr);
}

std::uint32_t Bells::rung() const { return mine_->rung.load(); }

// Sets the flag before it looks at the count, as `ring` counts before it looks at the flag: one sees the other.
void Bells::sleep(std::uint32_t before, std::chrono::microseconds longest) {
  const timespec timeout{0, static_cast<long>(std::chrono::nanoseconds(longest).count())};
  mine_->sleeper.store(1);
  futex(mine_->rung, FUTEX_WAIT, before, &timeout);
  mine_->sleeper.store(0);
}

void Bells::take_down() { MPI_Win_free(&window_); }

}  // namespace mars::hal
