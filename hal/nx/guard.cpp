#include "hal/nx/guard.h"

#include <cstdio>
#include <exception>

#include "hal/failure/explain.h"
#include "hal/nx/nx_errno.h"

namespace mars::hal {
namespace {

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

long fail_by_errno(const CallFailure& failure) {
  last_failure = failure.what();
  errno = failure.code;
  return -1;
}

}  // namespace mars::hal

extern "C" void nx_perror(const char* text) {
  const std::string& told = mars::hal::last_failure;
  std::fprintf(stderr, "%s: %s\n", text, told.empty() ? "no call has failed" : told.c_str());
}
