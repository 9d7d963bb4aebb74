#include "hal/nx/guard.h"

#include <cerrno>
#include <cstdio>
#include <exception>

#include "hal/failure/explain.h"
#include "hal/nx/nx_errno.h"

namespace mars::nx {
namespace {

// One list of errors: its numbers here, its names for C in nx_errno.h.
static_assert(messages::kMessageTooLong == EQMSGLONG && messages::kBadType == EQTYPE &&
              messages::kNoSuchNode == EQNODE && messages::kNoSuchPid == EQPID && messages::kBadLength == EQLEN &&
              messages::kNoSuchId == EQMID && messages::kNoFreeId == EQNOMID && messages::kNullBuffer == EQPBUF);

EndProgram end_program = nullptr;

thread_local std::string last_failure;

}  // namespace

void end_program_on_failure(EndProgram end) { end_program = end; }

void fail_plainly() {
  if (end_program == nullptr) throw;
  try {
    throw;
  } catch (const std::exception& failure) {
    end_program(reason_of(failure));
  }
  std::terminate();
}

long fail_by_errno(const messages::CallFailure& failure) {
  last_failure = failure.what();
  errno = failure.code;
  return -1;
}

}  // namespace mars::nx

extern "C" void nx_perror(const char* text) {
  const std::string& reason = mars::nx::last_failure;
  std::fprintf(stderr, "%s: %s\n", text, reason.empty() ? "no call has failed" : reason.c_str());
}
