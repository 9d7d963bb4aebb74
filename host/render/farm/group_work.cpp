#include "host/render/farm/group_work.h"

#include <algorithm>
#include <utility>

namespace mars::farm {

GroupWork::GroupWork(const collectives::Group& group, std::int32_t contributors, const sinks::SinkPool::Shape& sinks)
    : group_(group), contributors_(contributors), compositor_(sinks.width, sinks.height, sinks.block, sinks.format) {}

void GroupWork::give(const Task& task, std::uint64_t background, double now) {
  tasks_.push_back({Assembly(task, group_, contributors_), background, now});
  if (tasks_.size() == 1) begin_interval();
}

std::optional<std::uint32_t> GroupWork::drawn_by(std::int32_t node) const {
  for (const Given& task : tasks_)
    if (const auto frame = task.assembly.drawn_by(node)) return frame;
  return std::nullopt;
}

bool GroupWork::wants(const wire::Strip& strip) const {
  return std::any_of(tasks_.begin(), tasks_.end(), [&](const Given& task) { return task.assembly.wants(strip); });
}

void GroupWork::receive(StripMessage strip) {
  const auto task = std::find_if(tasks_.begin(), tasks_.end(),
                                 [&](const Given& each) { return each.assembly.wants(strip.header()); });
  task->assembly.receive(std::move(strip));
}

bool GroupWork::prepare(sinks::SinkPool& sinks) {
  return !tasks_.empty() && tasks_.front().assembly.prepare(compositor_, sinks);
}

std::optional<GroupWork::Composed> GroupWork::compose(sinks::SinkPool& sinks, StripStore& store) {
  if (tasks_.empty()) return std::nullopt;
  auto& [assembly, background, given] = tasks_.front();
  std::optional<Assembly::Pasted> pasted = assembly.paste(compositor_, sinks, store);
  if (!pasted) return std::nullopt;
  Composed composed{std::move(*pasted), assembly.interval(), given, compositor_.take_counts()};
  if (assembly.done()) {
    tasks_.pop_front();
    if (!tasks_.empty()) begin_interval();
  }
  return composed;
}

}  // namespace mars::farm
