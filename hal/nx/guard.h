// The wrappers of NX calls for C: the plain form and the twin of each call are
//   void csend(...) { plain([&] { process().csend(...); }); }
//   long _csend(...) { return twin([&] { process().csend(...); }); }
#pragma once

#include <string>
#include <type_traits>

#include "hal/messages/call_failure.h"
#include "hal/nx/call_lock.h"

namespace mars::nx {

// From now on a plain call that fails calls `end` with the reason; `end` ends this program and all other
// ranks and never returns. For C programs, set before their first call; without it plain calls throw.
using EndProgram = void (*)(const std::string& reason);
void end_program_on_failure(EndProgram end);

// For the exception at hand, in a catch clause: ends the program, or throws it again.
[[noreturn]] void fail_plainly();
// Stores the text for nx_perror, sets errno, returns -1.
long fail_by_errno(const messages::CallFailure& failure);

template <class Call>
auto plain(Call call) try {
  const CallLock lock;
  return call();
} catch (...) {
  fail_plainly();
}

// Only failures of the call itself return: a program cannot handle others (another rank's end, a broken network).
template <class Call>
long twin(Call call) try {
  const CallLock lock;
  if constexpr (std::is_void_v<decltype(call())>) {
    call();
    return 0;
  } else {
    return static_cast<long>(call());
  }
} catch (const messages::CallFailure& failure) {
  return fail_by_errno(failure);
} catch (...) {
  fail_plainly();
}

}  // namespace mars::nx
