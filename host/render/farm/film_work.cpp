#include "host/render/farm/film_work.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>

#include "host/render/farm/shares.h"

namespace mars::farm {
namespace {

// That a node took itself, without waiting for the host, or for others of a team that shares an inbetween.
double own_seconds(const wire::PhaseTimes& times) {
  return times.dice + times.sum + times.map + times.exchange + times.fill + times.scanline + times.shadow +
         times.depth + times.compose;
}

// `slowness` 1: no longer.
std::string slow_text(const std::string& node, double slowness) {
  if (slowness <= 1) return node + " is about as fast as the others again";
  std::array<char, 16> times{};
  std::snprintf(times.data(), times.size(), "%.1f", slowness);
  return node + " takes " + times.data() +
         " times as long as others for an inbetween and gets fewer: its processor or its link is slow, or busy "
         "otherwise";
}

}  // namespace

FilmWork::FilmWork(const FilmRun& run, FilmPictures& pictures)
    : run_(run), pictures_(pictures), rates_(run.engine.inbox().hellos().size()) {}

bool FilmWork::give_work() {
  const std::size_t before = next_task_;
  pictures_.note_with_sinks();
  run_.listener.more ? give_when_asked() : give_tasks();
  return next_task_ > before;
}

// Every group gets its first before any gets one ahead: there may be few.
void FilmWork::give_tasks() {
  for (std::size_t ahead = 1; ahead <= kTasksAhead; ++ahead)
    for (GroupWork& group : pictures_.groups())
      if (!group.is_open() && group.tasks() < ahead && next_task_ < run_.plan.tasks.size()) give(group);
}

void FilmWork::give_when_asked() {
  GroupWork& group = pictures_.groups().front();
  if (group.tasks() > 0 || !pictures_.sinks_have_all() || next_task_ == run_.plan.tasks.size()) return;
  wanted_ = run_.listener.more();
  if (wanted_) give(group);
}

void FilmWork::give(GroupWork& to) {
  const double given = run_.engine.seconds();
  const Task& task = run_.plan.tasks[next_task_++];
  to.give(task, background_pixel(run_.film, run_.film.intervals()[task.interval], run_.sinks.shape().format), given);
  give_portion(to);
}

void FilmWork::give_portion(GroupWork& to) {
  const Task& task = to.open_task();
  const ScopedSpan span(trace::HostSpan::give, task.interval);
  const std::vector<Standing> before = to.standings(rates_);
  const Portion portion =
      to.give_portion(before, run_.options.adapts ? kTurnsInPortion * before.size() : task.frames.size());
  Engine::send(to.group(), wire::kRender, render_command(task, portion, to.group(), to.division()));
  note_given(to, before, portion);
}

// Teams that had nothing left of a task that goes on were idle until now.
void FilmWork::note_given(const GroupWork& group, const std::vector<Standing>& before, const Portion& portion) {
  const double now = run_.engine.seconds();
  for (std::int32_t number = 0; number < group.team_count(); ++number) {
    const bool was_idle = portion.first > 0 && before[static_cast<std::size_t>(number)].waiting == 0;
    const bool has_some = std::ranges::count(portion.cycle, number) > 0;
    const collectives::Group team = group.team(number);
    for (int node = team.first; node < team.first + team.count; ++node) {
      if (was_idle) rates_.ready(node, now);
      if (!portion.cycle.empty()) rates_.given(node, has_some);
    }
  }
}

void FilmWork::note_taken(const wire::Strip& strip) {
  if (strip.last == 0) return;
  if (run_.options.each_frame) run_.report.strips.push_back(strip);
  if (run_.options.adapts) adapt(strip, pictures_.group_of(strip.node));
}

// To a node's last strip of a frame. Nodes begin with inbetweens when the keyframe is there.
void FilmWork::adapt(const wire::Strip& last, GroupWork& by) {
  const double now = run_.engine.seconds();
  if (last.kind == wire::FrameKind::keyframe) {
    const collectives::Group& group = by.group();
    for (int node = group.first; node < group.first + group.count; ++node) rates_.ready(node, now);
    return;
  }
  rates_.came(last.node, now, own_seconds(last.times), work_of(last.work));
  report_slow_nodes();
  if (by.is_open() && runs_short(by.standings(rates_))) give_portion(by);
}

void FilmWork::report_slow_nodes() {
  for (const int node : rates_.take_changed()) {
    const double slowness = rates_.slowness(node);
    pictures_.warn(slow_text(run_.engine.inbox().name_of(node), slowness));
    if (run_.listener.slowed) run_.listener.slowed(node, slowness);
  }
}

}  // namespace mars::farm
