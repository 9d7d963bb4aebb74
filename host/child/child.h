// A program started in a process group of its own, whose output and end come in as they happen, and which
// ends when we do. What it started and did not wait for becomes ours and is waited for too, so nothing is
// left behind. One child at a time: listeners start none.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <functional>
#include <optional>
#include <set>
#include <string>

#include "hal/failure/failure.h"
#include "host/child/command.h"
#include "host/child/descriptor.h"
#include "host/child/process.h"
#include "host/child/signal_relay.h"

namespace mars::child {

class Child {
 public:
  struct Listener {
    std::function<void(const std::string& line)> output;  // without the line's end
    std::function<void(const std::string& line)> error;
    std::function<void()> tick;  // now and then, at least as often as asked
  };

  // Throws Failure where the program cannot be started.
  explicit Child(const Command& command);
  ~Child() = default;  // kills it if it still runs
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  // Until it has ended and its output is read. SIGINT, SIGTERM and SIGHUP that come to us are passed on; what
  // has not ended some seconds after is killed, and what the kernel holds even then is left.
  Ending wait(const Listener& listener);

  // For listeners: ends it as a SIGTERM to us would.
  void stop();

  pid_t id() const { return process_->id(); }

  // The first signal that came to us and was passed on; 0: none.
  int passed_on() const { return relay_ ? relay_->first() : 0; }

 private:
  using Clock = std::chrono::steady_clock;

  // A pipe's reading end and the line that is not complete yet.
  struct Stream {
    Descriptor descriptor;
    std::string rest;
  };

  void wait_for_output();
  void take(Stream& stream, const std::function<void(const std::string&)>& listener);
  void reap();
  void notice_signals();
  void end_what_is_due();
  bool ended() const { return ending_ && !orphans_ && !output_.descriptor.open() && !error_.descriptor.open(); }

  std::set<pid_t> strangers_;  // children of ours that were there before it
  std::optional<Process> process_;
  std::optional<SignalRelay> relay_;
  Stream output_;
  Stream error_;
  std::optional<Ending> ending_;  // once it has ended
  bool orphans_ = false;          // processes that it started may still run
  bool given_up_ = false;         // what is left does not die
  int signals_noticed_ = 0;
  enum class Stage { running, asked_to_end, killed, draining, orphans_killed } stage_ = Stage::running;
  Clock::time_point deadline_ = Clock::time_point::max();  // of the stage
};

// A signal to us ended a child.
class Stopped : public Failure {
 public:
  using Failure::Failure;
};

// Throws Stopped where that is so.
void fail_if_stopped(const Child& child);

struct TimedEnding {
  Ending ending;
  bool late = false;  // it had not ended in time, and was stopped
};

// Waits as Child::wait does, but stops a child that has not ended after `longest`. Throws Stopped as fail_if_stopped.
TimedEnding wait_at_most(Child& child, std::chrono::milliseconds longest,
                         const std::function<void(const std::string& line)>& output,
                         const std::function<void(const std::string& line)>& error);

}  // namespace mars::child
