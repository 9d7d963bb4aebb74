// The system's sleep on a word of memory that processes may share.
#pragma once

#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <ctime>

namespace mars::messages {

static_assert(std::atomic<std::uint32_t>::is_always_lock_free, "processes share these");

// FUTEX_WAIT while the word is `value`, or FUTEX_WAKE for a number of waiters. Not one of glibc's calls. Any of its
// errors means: look again.
inline void futex(std::atomic<std::uint32_t>& word, int operation, std::uint32_t value, const timespec* timeout) {
  syscall(SYS_futex, reinterpret_cast<std::uint32_t*>(&word), operation, value, timeout, nullptr, 0);
}

}  // namespace mars::messages
