#include "host/render/farm/plan.h"

#include <algorithm>
#include <cstring>

namespace mars::farm {
namespace {

constexpr std::size_t kTasksPerGroup = 4;

}  // namespace

std::uint32_t Plan::inbetweens() const {
  std::size_t count = 0;
  for (const Task& task : tasks) count += task.frames.size() - 1;
  return static_cast<std::uint32_t>(count);
}

std::int32_t Plan::contributors_of(const collectives::Group& group) const {
  return contributors == 0 ? group.count : std::min(contributors, group.count);
}

std::int32_t Plan::teams_of(const collectives::Group& group) const {
  return std::max(1, group.count / std::max(sharers, 1));
}

Plan make_plan(const wire::PackedFilm& film, const PlanRequest& request, int nodes) {
  Plan plan{make_tasks(film, request.frames, request.coherence, request.most_frames),
            {},
            request.contributors,
            request.sharers};
  plan.groups = make_groups(nodes, static_cast<int>(request.groups), plan.tasks.size());
  return plan;
}

Portion whole(const Task& task) { return {0, task.frames.size() - 1}; }

std::vector<std::byte> render_command(const Task& task, const Portion& portion, const collectives::Group& group,
                                      const Division& division) {
  const bool goes_on = portion.first > 0;
  const std::span<const std::uint32_t> all(task.frames);
  const auto frames = goes_on ? all.subspan(1 + portion.first, portion.count) : all;
  const bool listed = frames.back() - frames.front() + 1 != frames.size();
  wire::Render command{};
  command.interval = task.interval;
  command.group_first = group.first;
  command.group_count = group.count;
  command.contributors = division.contributors;
  command.teams = division.teams;
  command.frame_count = static_cast<std::uint32_t>(frames.size());
  command.first_frame = frames.front();
  command.first_inbetween = task.first_inbetween + portion.first;
  command.drawn = static_cast<std::uint32_t>(portion.count + (goes_on ? 0 : 1));
  command.cycle = static_cast<std::uint16_t>(portion.cycle.size());
  command.listed = listed ? 1 : 0;
  command.goes_on = goes_on ? 1 : 0;
  const std::size_t list_bytes = listed ? frames.size_bytes() : 0;
  const auto cycle = std::as_bytes(std::span(portion.cycle));
  std::vector<std::byte> message(sizeof command + list_bytes + cycle.size());
  std::memcpy(message.data(), &command, sizeof command);
  if (listed) std::memcpy(message.data() + sizeof command, frames.data(), list_bytes);
  std::ranges::copy(cycle, message.begin() + static_cast<std::ptrdiff_t>(sizeof command + list_bytes));
  return message;
}

std::vector<std::byte> render_command(const Task& task, const collectives::Group& group, const Division& division) {
  return render_command(task, whole(task), group, division);
}

std::vector<Task> make_tasks(const wire::PackedFilm& film, std::span<const std::uint32_t> frames, bool coherence,
                             std::uint32_t most_frames) {
  std::vector<Task> tasks;
  std::uint64_t inbetweens = 0;
  std::uint32_t interval = 0;
  for (const std::uint32_t frame : frames) {
    const auto end = [&] { return film.intervals()[interval].first_frame + film.intervals()[interval].frame_count; };
    while (frame >= end()) ++interval;
    const bool goes_on = coherence && !tasks.empty() && tasks.back().interval == interval;
    if (goes_on)
      ++inbetweens;
    else
      tasks.push_back({interval, {}, inbetweens});
    tasks.back().frames.push_back(frame);
  }
  return most_frames > 0 ? cut_tasks(tasks, most_frames) : tasks;
}

std::vector<Task> cut_tasks(std::span<const Task> tasks, std::uint32_t most_frames) {
  std::vector<Task> pieces;
  std::uint64_t inbetweens = 0;
  for (const Task& task : tasks) {
    const std::size_t all = task.frames.size(), count = (all + most_frames - 1) / most_frames;
    for (std::size_t piece = 0; piece < count; ++piece) {
      const auto at = [&](std::size_t number) {
        return task.frames.begin() + static_cast<std::ptrdiff_t>(all * number / count);
      };
      pieces.push_back({task.interval, {at(piece), at(piece + 1)}, inbetweens});
      inbetweens += pieces.back().frames.size() - 1;
    }
  }
  return pieces;
}

std::vector<collectives::Group> make_groups(int nodes, int groups, std::size_t tasks) {
  const std::size_t most = std::min(tasks / kTasksPerGroup, static_cast<std::size_t>(nodes));
  const int count = std::clamp(groups == 0 ? static_cast<int>(most) : groups, 1, nodes);
  std::vector<collectives::Group> out;
  for (int i = 0; i < count; ++i) out.push_back(collectives::group_of(nodes, count, i));
  return out;
}

}  // namespace mars::farm
