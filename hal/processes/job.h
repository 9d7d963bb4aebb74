// The process that starts the ranks of a job over shared memory (segment.h) and sees them to their end: it
// alone forks, waits for and kills them, stops the others when one dies, and leaves nothing behind. The
// host asks it, through a socket, to load and to kill nodes.
#pragma once

#include <signal.h>
#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hal/processes/place.h"
#include "hal/processes/segment.h"

namespace mars::processes {

struct JobPlan {
  int nodes = 1;
  bool host = false;
  // When nodes begin that the host does not load: with it; when it asks, or has ended; or never.
  enum class Begin { at_once, later, never };
  Begin begin = Begin::at_once;
  std::uint64_t limit = 0;  // bytes that messages under way may take
  // A rank's program, called in its process; returns its exit code if it returns at all. `file` is what the
  // host asked to be loaded, "" where it did not ask.
  std::function<int(const Place& place, const std::string& file)> become;
  // A line about what went wrong.
  std::function<void(const std::string& line)> report;
};

class Job {
 public:
  explicit Job(JobPlan plan);
  ~Job();
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  // Runs it to its end. Returns the worst exit code: 128 and the signal of one that died, or of the one that
  // ended us.
  int run();

 private:
  struct Process {
    pid_t id = 0;         // 0: none runs
    bool killed = false;  // because the host asked
  };

  void start(int index, const std::string& file);
  void begin();
  bool running(int first, int last) const;
  void serve();
  void answer(const JobRequest& request);
  void kill_nodes(int node);
  void take_signals();
  void reap();
  void note_end(int index, int status);
  void note_failure(const std::string& reason);
  bool stands_still() const;
  std::uint64_t taken() const;
  void look_for_standstill();
  std::string name(int index) const;
  void hurry();
  void kill_all(int signal);

  JobPlan plan_;
  Segment segment_;
  std::vector<Process> processes_;
  bool asked_ = false;  // the host has, for nodes
  int ours_ = -1;       // the socket's ends
  int hosts_ = -1;
  int signals_ = -1;
  sigset_t signals_before_{};
  int code_ = 0;
  int passed_on_ = 0;
  int standing_still_ = 0;  // looks at which nothing could move
  std::uint64_t last_taken_ = 0;
  std::chrono::steady_clock::time_point next_look_{};
  std::optional<std::chrono::steady_clock::time_point> deadline_;  // for processes to end, before they are killed
};

}  // namespace mars::processes
