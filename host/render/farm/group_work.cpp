#include "host/render/farm/group_work.h"

#include <algorithm>
#include <utility>

namespace mars::farm {

GroupWork::GroupWork(const collectives::Group& group, const Division& division, const sinks::SinkPool::Shape& sinks,
                     Assignments& assignments)
    : group_(group),
      division_(division),
      assignments_(&assignments),
      compositor_(sinks.width, sinks.height, sinks.block, sinks.format) {}

void GroupWork::give(const Task& task, std::uint64_t background, double now) {
  tasks_.push_back({Assembly(task, group_, division_, *assignments_), background, now});
  open_ = &task;
  next_inbetween_ = 0;
  if (tasks_.size() == 1) begin_interval();
}

std::vector<Standing> GroupWork::standings(const NodeRates& rates) const {
  std::vector<Standing> standings;
  for (std::int32_t number = 0; number < team_count(); ++number) {
    Standing& standing = standings.emplace_back();
    for (int node = team(number).first; node < team(number).first + team(number).count; ++node) {
      const std::size_t waiting = assignments_->inbetweens(node, tasks_.back().assembly.interval());
      standing.waiting = std::max(standing.waiting, waiting);
      standing.slowness = std::max(standing.slowness, rates.slowness(node));
      standing.forgotten |= rates.is_forgotten(node);
    }
  }
  return standings;
}

Portion GroupWork::give_portion(const std::vector<Standing>& standings, std::size_t most) {
  Portion portion{next_inbetween_, std::min(most, open_->frames.size() - 1 - next_inbetween_)};
  portion.cycle = share_out(standings, open_->first_inbetween + portion.first, portion.count);
  tasks_.back().assembly.give(*open_, portion, *assignments_);
  next_inbetween_ += portion.count;
  if (next_inbetween_ + 1 == open_->frames.size()) open_ = nullptr;
  return portion;
}

std::deque<GroupWork::Given>::iterator GroupWork::task_of(std::uint32_t frame) {
  return std::ranges::find_if(tasks_, [frame](const Given& task) { return task.assembly.has(frame); });
}

void GroupWork::receive(StripMessage strip) { task_of(strip.header().frame)->assembly.receive(std::move(strip)); }

bool GroupWork::awaits_file(std::uint32_t frame) const {
  return std::ranges::any_of(tasks_, [&](const Given& task) { return task.assembly.awaits_file(frame); });
}

// Tasks may end in any order.
std::optional<GroupWork::Composed> GroupWork::note(std::uint32_t frame, Note note) {
  const auto task = task_of(frame);
  const auto whole = (task->assembly.*note)(frame);
  if (!whole) return std::nullopt;
  Composed composed{*whole, task->assembly.interval(), task->given, {}};
  if (task->assembly.done()) tasks_.erase(task);
  return composed;
}

bool GroupWork::prepare(sinks::SinkPool& sinks) {
  return !tasks_.empty() && tasks_.front().assembly.prepare(compositor_, sinks);
}

std::optional<GroupWork::Composed> GroupWork::compose(sinks::SinkPool& sinks, StripStore& store,
                                                      const PasteListener& listener) {
  if (tasks_.empty()) return std::nullopt;
  auto& [assembly, background, given] = tasks_.front();
  std::optional<Assembly::Pasted> pasted = assembly.paste(compositor_, sinks, store, listener);
  if (!pasted) return std::nullopt;
  Composed composed{std::move(*pasted), assembly.interval(), given, compositor_.take_counts()};
  if (assembly.done()) {
    tasks_.pop_front();
    if (!tasks_.empty()) begin_interval();
  }
  return composed;
}

}  // namespace mars::farm
