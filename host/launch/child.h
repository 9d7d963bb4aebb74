// A program started in a process group of its own, whose output and end come in as they happen, and which
// ends when we do. What it started and did not wait for becomes ours and is waited for too, so nothing is
// left behind. Waiting is sleeping: one poll over its output and the signals sent to us. One child at a time.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "host/launch/command.h"

namespace mars::host {

// How a program ended.
struct Ending {
  int code = 0;    // it gave
  int signal = 0;  // that killed it; 0: none
};

class Child {
 public:
  struct Listener {
    std::function<void(const std::string& line)> output;  // without the line's end
    std::function<void(const std::string& line)> error;
    std::function<void()> tick;  // now and then, at least as often as asked
  };

  // Throws Failure where the program cannot be started.
  explicit Child(const Command& command);
  ~Child();  // kills it if it still runs
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  // Until it has ended and its output is read. SIGINT, SIGTERM and SIGHUP that come to us are passed on; what
  // has not ended some seconds after is killed.
  Ending wait(const Listener& listener);

  // For listeners: ends it as a SIGTERM to us would.
  void stop();

  // The first signal that was passed on; 0: none.
  int passed_on() const { return passed_on_; }

 private:
  // A pipe's reading end and the line that is not complete yet.
  struct Stream {
    int descriptor = -1;
    std::string rest;
  };

  void start(const Command& command, int output, int error);
  void take(Stream& stream, const std::function<void(const std::string&)>& tell);
  void take_signals();
  void pass_on(int signal);
  void reap();
  bool ended() const { return status_ && !orphans_ && output_.descriptor < 0 && error_.descriptor < 0; }

  pid_t process_ = -1;
  Stream output_;
  Stream error_;
  int signals_ = -1;  // a signalfd
  sigset_t signals_before_{};
  std::optional<int> status_;  // once it has ended
  bool orphans_ = false;       // processes that it started may still run
  bool orphans_killed_ = false;
  int passed_on_ = 0;
  std::optional<std::chrono::steady_clock::time_point> deadline_;  // to be killed, or to have read the rest
};

}  // namespace mars::host
