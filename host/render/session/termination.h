// A host that receives SIGTERM first reports what its nodes were drawing: while one lives, the signal is only
// noted, and end() is for when that is said.
#pragma once

#include <signal.h>

namespace mars::session {

class Termination {
 public:
  // One at a time in a process. `wanted`: no: the signal does what it did.
  explicit Termination(bool wanted);
  ~Termination();
  Termination(const Termination&) = delete;
  Termination& operator=(const Termination&) = delete;

  bool asked() const;
  // By that signal.
  [[noreturn]] void end();

 private:
  const bool wanted_;
  struct sigaction before_ {};
};

}  // namespace mars::session
