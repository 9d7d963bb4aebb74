// The host while a rendering is played through: as host/render/farm does it, it gives tasks, takes strips one by one,
// composes frames where they may be, hands them to sinks and gives credit back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <utility>
#include <vector>

#include "hal/simulated/storage_use.h"
#include "host/experiments/forecast/clockwork.h"
#include "host/experiments/forecast/computers.h"
#include "host/experiments/forecast/costs.h"
#include "host/experiments/forecast/frame_costs.h"
#include "host/experiments/forecast/setting.h"
#include "host/render/events/course.h"
#include "host/render/farm/plan.h"

namespace mars::forecast {

// Or word that the frame's file is there, where nodes write files.
struct StripSent {
  int node;
  std::size_t task;
  std::size_t frame;     // of the task
  double bytes;          // of its message
  double pasting;        // seconds
  bool last;             // of the node's for this frame
  bool written = false;  // the file is there
};

class HostSide {
 public:
  // What reaches nodes: a task for all of a group, a credit for one.
  struct Outward {
    std::function<void(std::size_t group, std::size_t task)> task;
    std::function<void(int node)> credit;
  };

  HostSide(Clockwork& clockwork, Computers& computers, simulated::StorageUse& storage, const farm::Plan& plan,
           const Setting& setting, const farm::HostMemory& memory, int nodes, Outward outward);

  // Of each task in order.
  void add_costs(HostCosts costs) { host_costs_.push_back(std::move(costs)); }
  void begin();
  void arrive(const StripSent& strip);

  std::vector<events::ExpectedFrame>& frames() { return composed_; }
  // When the sinks had taken the last frame.
  double ended() const { return ended_; }

 private:
  struct Frame {
    int contributors_left;
    bool has_picture = false;
    double begun = 0;               // seconds that this took
    std::vector<StripSent> strips;  // that wait
  };
  struct GroupState {
    std::deque<std::size_t> tasks;
  };
  struct TaskState {
    std::size_t group = 0;
    bool background_there = false;
    std::size_t left = 0;  // frames
    std::vector<Frame> frames;
    std::vector<std::size_t> waiting;  // with strips
  };

  void wake();
  void go_on();
  void give_tasks();
  double give(std::size_t group);
  void take_back();
  bool compose_one();
  bool begin_frame(std::size_t task, std::size_t number);
  bool compose(std::size_t group, std::size_t task, std::size_t number);
  void finish_written(const StripSent& file);
  void submit(std::size_t task, std::size_t number);
  void busy(double seconds, Clockwork::Action then);
  void note(const StripSent& strip);

  Clockwork& clockwork_;
  Computers& computers_;
  simulated::StorageUse& storage_;
  const farm::Plan& plan_;
  const Setting setting_;
  const Costs costs_;
  const int self_;
  const Outward outward_;
  const double file_bytes_;
  const std::size_t buffers_;              // at most
  std::size_t made_ = 1;                   // so far
  std::vector<std::size_t> free_buffers_;  // the tasks whose background they show; the one given back last is last
  std::vector<HostCosts> host_costs_;      // by task
  std::vector<GroupState> groups_;
  std::vector<TaskState> tasks_;
  std::size_t next_task_ = 0;
  std::deque<StripSent> arrived_;
  std::deque<std::size_t> taken_;  // of frames that sinks have taken, the tasks
  bool idle_ = true;
  std::vector<events::ExpectedFrame> composed_;
  double ended_ = 0;
};

}  // namespace mars::forecast
