#include "host/experiments/forecast/host_side.h"

#include <algorithm>
#include <utility>

namespace mars::forecast {
namespace {

using wire::Work;

constexpr std::size_t kNothing = static_cast<std::size_t>(-1);

}  // namespace

HostSide::HostSide(Clockwork& clockwork, simulated::Computers& computers, simulated::StorageUse& storage,
                   const FilmCounts& counts, const farm::Plan& plan, const Setting& setting,
                   const farm::HostMemory& memory, int nodes, Outward outward)
    : clockwork_(clockwork),
      computers_(computers),
      storage_(storage),
      plan_(plan),
      setting_(setting),
      frame_costs_(setting, nodes),
      costs_(frame_costs_.costs()),
      self_(nodes),
      outward_(std::move(outward)),
      buffers_(memory.frames),
      free_buffers_{{0, kNothing}},
      bands_(setting.picture, setting.film.settings().width, setting.film.settings().height),
      groups_(plan.groups.size()),
      tasks_(plan.tasks.size()) {
  if (!counts.is_exact || setting.nodes_write()) return;
  blocks_.emplace(counts, bands_.width(), bands_.height(), static_cast<double>(wire::pixel_bytes(setting.pixels())));
  for (TaskState& task : tasks_) task.kept_bands.resize(bands_.count());
}

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
  busy_seconds_ += seconds;
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
  const collectives::Group& nodes = plan_.groups[group];
  const farm::Division division = plan_.division_of(nodes);
  task.group = group;
  task.left = frames.size();
  for (std::size_t frame = 0; frame < frames.size(); ++frame)
    task.frames.push_back(
        {.contributors_left = frame == 0 ? division.contributors
                                         : wire::team_of_inbetween(plan_.tasks[number].first_inbetween + frame - 1,
                                                                   nodes, division.teams)
                                               .count});
  groups_[group].tasks.push_back(number);
  outward_.task(group, number);
  return nodes.count *
         costs_.host_to_send(static_cast<double>(farm::render_command(plan_.tasks[number], nodes, division).size()));
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
  // It waits for the rest of an announced one alone.
  const double there = outward_.answer(strip);
  if (there > clockwork_.now()) return clockwork_.at(there, [this, strip] { receive(strip); });
  receive(strip);
}

void HostSide::receive(const StripSent& strip) {
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
  for (const Buffer& buffer : std::exchange(taken_, {})) free_buffers_.push_back(buffer);
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
  if (free_buffers_.empty()) free_buffers_.push_back({made_++, kNothing});
  auto buffer = std::ranges::find(free_buffers_.rbegin(), free_buffers_.rend(), task, &Buffer::task);
  if (buffer == free_buffers_.rend()) buffer = free_buffers_.rbegin();
  frame.buffer = buffer->number;
  if (blocks_)
    blocks_->begin(frame.buffer, task, number);
  else if (buffer->task != task && number > 0)
    frame.begun = host_costs_[task].background;
  std::swap(*buffer, free_buffers_.back());
  free_buffers_.pop_back();
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
  if (blocks_) seconds += restore(number, place, whole);
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

// All of the frame's pixels at once, with its first strips. Sinks restore the rest, if there are any.
double HostSide::restore(std::size_t task, std::size_t place, bool whole) {
  Frame& frame = tasks_[task].frames[place];
  double bytes = 0;
  if (!std::exchange(frame.is_pasted, true)) bytes += blocks_->paste(frame.buffer, task, place);
  if (whole && !setting_.files) bytes += blocks_->restore(frame.buffer);
  return costs_.of(Work::host_restored, bytes);
}

// As sinks::FrameEncoder encodes bands: those of the background once.
double HostSide::file_seconds(std::size_t task, std::size_t place) {
  if (!blocks_) return host_costs_[task].files[place];
  const std::size_t buffer = tasks_[task].frames[place].buffer;
  double lines = 0;
  for (std::size_t band = 0; band < bands_.count(); ++band) {
    const images::Lines of_band = bands_.lines_of(band);
    const bool is_changed = blocks_->is_changed(buffer, of_band.first, of_band.end);
    if (!is_changed && tasks_[task].kept_bands[band]) continue;
    if (!is_changed) tasks_[task].kept_bands[band] = true;
    blocks_->forget_stale(buffer, of_band.first, of_band.end);
    lines += of_band.count();
  }
  return frame_costs_.encoding(lines) + frame_costs_.writing();
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
    const double made = computers_.reserve(self_, now, file_seconds(task, place));
    end = storage_.write(computers_.of(self_), made, frame_costs_.file_bytes(), now);
  }
  ended_ = std::max(ended_, end);
  const std::size_t buffer = tasks_[task].frames[place].buffer;
  clockwork_.at(end, [this, task, buffer] {
    taken_.push_back({buffer, task});
    wake();
  });
  give_tasks();
}

}  // namespace mars::forecast
