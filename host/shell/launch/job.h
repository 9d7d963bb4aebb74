// One job, a host and its nodes, followed by the host's events from its start to its end.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "host/child/child.h"
#include "host/child/command.h"
#include "host/render/events/events.h"
#include "host/shell/launch/diagnosis.h"
#include "host/shell/launch/display.h"
#include "host/shell/launch/job_watch.h"

namespace mars::launch {

class Job {
 public:
  using Clock = std::chrono::steady_clock;

  // What others do meanwhile; they start no program.
  struct Listener {
    Clock::duration patience;                   // with nodes that do not all answer, until `waited`
    std::function<void(child::Child&)> waited;  // called once then
    std::function<void()> tick;                 // now and then
    std::function<bool()> is_in_vain = {};      // asked as often: whether to stop the job; none: never
  };

  explicit Job(Display& display) : display_(display) {}

  // Starts it and returns when it has ended, or was ended because it hangs.
  void follow(const child::Command& command, const Listener& listener);

  const Remains& remains() const { return remains_; }
  double boot_seconds() const { return boot_seconds_; }

 private:
  void take_output(const std::string& line);
  void take(const events::Event& event);
  void take_error(const std::string& line);
  void look_after(child::Child& child, const Listener& listener);
  void end_if_it_hangs(child::Child& child);
  void begin_loading(const events::Loading& loading);
  void end_loading(const events::Loaded& loaded);
  void show_slow_load();

  Display& display_;
  const Clock::time_point started_ = Clock::now();
  JobWatch watch_{started_};
  Clock::time_point waiting_since_ = started_;  // for nodes; while loading_, for the film
  std::optional<events::Loading> loading_;
  bool overdue_ = false;  // nodes were waited for with all patience
  bool slow_load_shown_ = false;
  double boot_seconds_ = 0;
  Remains remains_;
};

}  // namespace mars::launch
