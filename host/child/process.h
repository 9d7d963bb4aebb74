// A process that this one starts: another program, or a function of ours in a copy of this process. All of MARS's
// programs but the launcher of processes in hal/ start their processes here. What also has to pass signals on, read
// lines and wait for grandchildren uses child.h, which stands on this.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "host/child/command.h"

namespace mars::child {

// How a process ended.
struct Ending {
  int code = 0;    // it gave
  int signal = 0;  // that killed it; 0: none

  bool well() const { return code == 0 && signal == 0; }
};

struct ProcessLimits {
  std::chrono::seconds processor_time;  // SIGXCPU ends it then
  std::uint64_t memory;                 // bytes, beyond what this process has
};

struct ProcessSetup {
  struct Stream {
    int number;      // in the new process
    int descriptor;  // ours
  };

  std::vector<Stream> streams{};          // all others are inherited, but those that close on exec
  bool own_group = false;                 // it leads a process group
  int signal_at_our_end = 0;              // it gets when this thread ends, however it ends; 0: none
  std::vector<int> default_signals{};     // that act on it as usual, though we may ignore them
  int niceness = 0;                       // from which its program begins; 0: ours
  std::optional<ProcessLimits> limits{};  // with these it leaves no core file either
};

class Process {
 public:
  // Throws Failure with the system's reason where the program cannot be started.
  Process(const Command& command, const ProcessSetup& setup);
  // `work` returns the process' exit code. It runs in a copy of this thread alone.
  Process(const std::function<int()>& work, const ProcessSetup& setup);
  // Kills it, with its group if it leads one, where it has not ended; what the kernel then still holds is left.
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  pid_t id() const { return id_; }

  Ending wait();
  // None: it still runs.
  std::optional<Ending> poll();
  // It is left to itself: neither killed nor waited for.
  void give_up() { left_ = true; }
  // To it, or its group if it leads one.
  void send(int signal) const;

 private:
  std::optional<Ending> ending(int options);

  pid_t id_ = -1;
  bool leads_group_;
  bool left_ = false;  // or waited for
};

}  // namespace mars::child
