#include "host/render/session/termination.h"

#include <csignal>
#include <cstdlib>

namespace mars::session {
namespace {

volatile std::sig_atomic_t is_asked = 0;

void note(int) { is_asked = 1; }

}  // namespace

Termination::Termination(bool wanted) : wanted_(wanted) {
  if (!wanted) return;
  struct sigaction action {};
  action.sa_handler = note;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGTERM, &action, &before_);
}

// One that came too late to be seen does what it would have done.
Termination::~Termination() {
  if (!wanted_) return;
  sigaction(SIGTERM, &before_, nullptr);
  if (asked()) std::raise(SIGTERM);
}

bool Termination::asked() const { return is_asked != 0; }

void Termination::end() {
  std::signal(SIGTERM, SIG_DFL);
  std::raise(SIGTERM);
  std::abort();
}

}  // namespace mars::session
