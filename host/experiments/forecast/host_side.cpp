#include "host/experiments/forecast/host_side.h"

#include <algorithm>
#include <utility>

namespace mars::forecast {
namespace {

using wire::Work;

constexpr std::size_t kNothing = static_cast<std::size_t>(-1);

}  // namespace

HostSide::HostSide(Clockwork& clockwork, Computers& computers, simulated::StorageUse& storage, const farm::Plan& plan,
                   const Setting& setting, const farm::HostMemory& memory, int nodes, Outward outward)
    : clockwork_(clockwork),
      computers_(computers),
      storage_(storage),
      plan_(plan),
      setting_(setting),
      costs_(setting.platform),
      self_(nodes),
      outward_(std::move(outward)),
      file_bytes_(FrameCosts(setting, nodes).file_bytes()),
      buffers_(memory.frames),
      free_buffers_(1, kNothing),
      groups_(plan.groups.size()),
      tasks_(plan.tasks.size()) {}

void HostSide::begin() {
  idle_ = false;
  give_tasks();
}

void HostSide::arrive(const StripSent& strip) {
  arrived_.push_back(strip);
  wake();
}

void HostSide::wake() {
  if (!std::exchange(idle_, false)) return;
  go_on();
}

void HostSide::busy(double seconds, Clockwork::Action then) {
  clockwork_.at(computers_.work(self_, clockwork_.now(), seconds), std::move(then));
}

// Every group gets its first before any gets one ahead.
void HostSide::give_tasks() {
  for (std::size_t ahead = 1; ahead <= farm::kTasksAhead; ++ahead)
    for (std::size_t group = 0; group < groups_.size(); ++group)
      if (groups_[group].tasks.size() < ahead && next_task_ < tasks_.size())
        return busy(give(group), [this] { give_tasks(); });
  go_on();
}

// The seconds that it takes.
double HostSide::give(std::size_t group) {
  const std::size_t number = next_task_++;
  TaskState& task = tasks_[number];
  const auto& frames = plan_.tasks[number].frames;
  const int nodes = plan_.groups[group].count, contributors = plan_.contributors_of(plan_.groups[group]);
  task.group = group;
  task.left = frames.size();
  for (std::size_t frame = 0; frame < frames.size(); ++frame)
    task.frames.push_back({frame == 0 ? contributors : 1, false, 0, {}});
  groups_[group].tasks.push_back(number);
  outward_.task(group, number);
  return nodes * costs_.host_to_send(
                     static_cast<double>(farm::render_command(plan_.tasks[number], plan_.groups[group], 1).size()));
}

void HostSide::go_on() {
  take_back();
  if (compose_one()) return;
  if (arrived_.empty()) {
    idle_ = true;
    return;
  }
  const StripSent strip = arrived_.front();
  arrived_.pop_front();
  busy(costs_.host_to_receive(strip.bytes) + costs_.of(Work::host_strip, 1), [this, strip] {
    if (strip.written) return finish_written(strip);
    if (!setting_.nodes_write()) note(strip);
    go_on();
  });
}

void HostSide::note(const StripSent& strip) {
  TaskState& task = tasks_[strip.task];
  Frame& frame = task.frames[strip.frame];
  if (strip.last) --frame.contributors_left;
  if (frame.strips.empty()) task.waiting.push_back(strip.frame);
  frame.strips.push_back(strip);
}

// Buffers of frames that sinks have taken.
void HostSide::take_back() {
  for (const std::size_t task : std::exchange(taken_, {})) free_buffers_.push_back(task);
}

bool HostSide::compose_one() {
  for (std::size_t group = 0; group < groups_.size(); ++group) {
    if (groups_[group].tasks.empty()) continue;
    const std::size_t number = groups_[group].tasks.front();
    TaskState& task = tasks_[number];
    for (std::size_t i = 0; i < task.waiting.size(); ++i) {
      const std::size_t frame = task.waiting[i];
      if (frame != 0 && !task.background_there) continue;
      if (!begin_frame(number, frame)) continue;
      task.waiting.erase(task.waiting.begin() + static_cast<std::ptrdiff_t>(i));
      return compose(group, number, frame);
    }
  }
  return false;
}

// As sinks::SinkPool gives buffers to frames that are whole, and earlier to others. It makes a new one where none is
// free.
bool HostSide::begin_frame(std::size_t task, std::size_t number) {
  Frame& frame = tasks_[task].frames[number];
  if (frame.has_picture) return true;
  const std::size_t left = frame.contributors_left == 0 ? 0 : std::max<std::size_t>(1, buffers_ / 2);
  if (free_buffers_.size() + buffers_ - made_ <= left) return false;
  if (free_buffers_.empty()) ++made_, free_buffers_.push_back(kNothing);
  auto buffer = std::ranges::find(free_buffers_.rbegin(), free_buffers_.rend(), task);
  if (buffer == free_buffers_.rend()) buffer = free_buffers_.rbegin();
  if (*buffer != task && number > 0) frame.begun = host_costs_[task].background;
  free_buffers_.erase(std::next(buffer).base());
  return frame.has_picture = true;
}

bool HostSide::compose(std::size_t group, std::size_t number, std::size_t place) {
  TaskState& task = tasks_[number];
  Frame& frame = task.frames[place];
  double seconds = std::exchange(frame.begun, 0);
  std::vector<int> free;
  for (const StripSent& strip : std::exchange(frame.strips, {})) {
    seconds += strip.pasting;
    free.push_back(strip.node);
  }
  seconds += static_cast<double>(free.size()) * costs_.host_to_send(sizeof(wire::Credit));
  const bool whole = frame.contributors_left == 0;
  if (whole) {
    seconds += costs_.of(Work::host_frame, 1);
    task.background_there |= place == 0;
    if (--task.left == 0) groups_[group].tasks.pop_front();
  }
  busy(seconds, [this, free, whole, number, place] {
    for (const int node : free) outward_.credit(node);
    if (whole) return submit(number, place);
    go_on();
  });
  return true;
}

void HostSide::finish_written(const StripSent& file) {
  ended_ = clockwork_.now();
  composed_.push_back({ended_, file.frame == 0 ? wire::FrameKind::keyframe : wire::FrameKind::inbetween});
  TaskState& task = tasks_[file.task];
  if (--task.left == 0) std::erase(groups_[task.group].tasks, file.task);
  give_tasks();
}

void HostSide::submit(std::size_t task, std::size_t place) {
  const double now = clockwork_.now();
  composed_.push_back({now, place == 0 ? wire::FrameKind::keyframe : wire::FrameKind::inbetween});
  double end = now;
  if (setting_.files) {
    const double made = computers_.reserve(self_, now, host_costs_[task].files[place]);
    end = storage_.write(made, file_bytes_, now);
  }
  ended_ = std::max(ended_, end);
  clockwork_.at(end, [this, task] {
    taken_.push_back(task);
    wake();
  });
  give_tasks();
}

}  // namespace mars::forecast
