// The signals that ask us to stop (SIGINT, SIGTERM, SIGHUP) while a child runs. Each goes to the child's process group
// as it comes: from the handler, so that it also arrives while we write to a terminal that nobody reads or wait for a
// disk that does not answer. If that still holds us up some seconds later, an alarm ends this process.
#pragma once

#include <signal.h>
#include <sys/types.h>

#include <array>
#include <chrono>

namespace mars::child {

class SignalRelay {
 public:
  // From the first signal to the end of this process, whatever it is doing then: longer than Child::wait takes.
  static constexpr std::chrono::seconds kLongest{15};
  // The same from the second signal: then a person does not want to wait.
  static constexpr std::chrono::seconds kLongestOnceMore{6};

  // From now on signals are counted and kept; `relay_to` says where they go. Within another relay, which lasts, as for
  // several children one after another, this one goes on with its signals. A SIGHUP that is ignored, as under nohup,
  // stays ignored.
  SignalRelay();
  // After the outermost the signals are again what they were. A stop that was asked for stays asked for: the alarm
  // stays set.
  ~SignalRelay();
  SignalRelay(const SignalRelay&) = delete;
  SignalRelay& operator=(const SignalRelay&) = delete;

  // How many signals have come, and which came first; 0: none.
  int count() const;
  int first() const;

  // `group`: the process group that gets the signals, also those that came before this call: several as one SIGKILL.
  void relay_to(pid_t group);
  // The same for a child of our own group, which has from the terminal what the terminal sends.
  void relay_to_member(pid_t process);

  // The group or process is gone: signals go nowhere from now on.
  void forget_group();

 private:
  void relay_to_target(pid_t target);

  bool within_another_;
  std::array<struct sigaction, 3> before_{};
};

// `signal` to a process group. Wakes what was stopped, which would not hear it.
void signal_group(pid_t group, int signal);

}  // namespace mars::child
