// The host while a rendering is played through: as host/render/farm does it, it gives tasks, takes strips one by one,
// composes frames where they may be, hands them to sinks and gives credit back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "hal/simulated/computers.h"
#include "hal/simulated/storage_use.h"
#include "host/experiments/forecast/clockwork.h"
#include "host/experiments/forecast/costs.h"
#include "host/experiments/forecast/frame_costs.h"
#include "host/experiments/forecast/host_blocks.h"
#include "host/experiments/forecast/setting.h"
#include "host/images/picture_bands.h"
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
  // What reaches nodes: a task for all of a group, a credit for one, and the answer to a strip that was announced,
  // which says when all of it is there.
  struct Outward {
    std::function<void(std::size_t group, std::size_t task)> task;
    std::function<void(int node)> credit;
    std::function<double(const StripSent& strip)> answer;
  };

  HostSide(Clockwork& clockwork, simulated::Computers& computers, simulated::StorageUse& storage,
           const FilmCounts& counts, const farm::Plan& plan, const Setting& setting, const farm::HostMemory& memory,
           int nodes, Outward outward);
  HostSide(auto&&, auto&&, auto&&, auto&&, const farm::Plan&&, auto&&...) = delete;

  // Of each task in order.
  void add_costs(HostCosts costs) { host_costs_.push_back(std::move(costs)); }
  void begin();
  void arrive(const StripSent& strip);

  std::vector<events::ExpectedFrame>& frames() { return composed_; }
  // Seconds that its loop worked.
  double busy_seconds() const { return busy_seconds_; }
  // When the sinks had taken the last frame.
  double ended() const { return ended_; }

 private:
  struct Frame {
    int contributors_left;
    bool has_picture = false;
    std::size_t buffer = 0;  // then
    double begun = 0;        // seconds that this took
    bool is_pasted = false;
    std::vector<StripSent> strips{};  // that wait
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
    std::vector<bool> kept_bands;      // of the background, that sinks have encoded
  };
  struct Buffer {
    std::size_t number;
    std::size_t task;  // whose background it shows
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
  double restore(std::size_t task, std::size_t place, bool whole);
  double file_seconds(std::size_t task, std::size_t place);
  void busy(double seconds, Clockwork::Action then);
  void receive(const StripSent& strip);
  void note(const StripSent& strip);

  Clockwork& clockwork_;
  simulated::Computers& computers_;
  simulated::StorageUse& storage_;
  const farm::Plan& plan_;
  const Setting setting_;
  const FrameCosts frame_costs_;
  const Costs& costs_;
  const int self_;
  const Outward outward_;
  const std::size_t buffers_;         // at most
  std::size_t made_ = 1;              // so far
  std::vector<Buffer> free_buffers_;  // the one given back last is last
  const images::PictureBands bands_;
  std::optional<HostBlocks> blocks_;   // of the buffers, where frames were counted exactly
  std::vector<HostCosts> host_costs_;  // by task
  std::vector<GroupState> groups_;
  std::vector<TaskState> tasks_;
  std::size_t next_task_ = 0;
  std::deque<StripSent> arrived_;
  std::deque<Buffer> taken_;  // of frames that sinks have taken
  bool idle_ = true;
  std::vector<events::ExpectedFrame> composed_;
  double ended_ = 0;
  double busy_seconds_ = 0;
};

}  // namespace mars::forecast
