#include "host/render/farm/film_pictures.h"

#include <algorithm>

#include "hal/messages/process.h"
#include "hal/nx/nx_messages.h"

namespace mars::farm {

FilmPictures::FilmPictures(const FilmRun& run) : run_(run), watch_(run.options.watch), frames_left_(run.plan.frames()) {
  for (const collectives::Group& group : run.plan.groups) {
    group_numbers_.insert(group_numbers_.end(), static_cast<std::size_t>(group.count),
                          static_cast<std::uint32_t>(groups_.size()));
    groups_.emplace_back(group, run.plan.division_of(group), run.sinks.shape(), run.engine.assignments());
  }
}

void FilmPictures::begin() {
  if (watch_ == nullptr) return;
  paste_listener_ = [this](const auto& strip, const auto& compositor, const auto& frame) {
    show(strip, compositor, frame);
  };
  const sinks::SinkPool::Shape& shape = run_.sinks.shape();
  watch_->begin({run_.film, shape.block, shape.format, static_cast<std::uint32_t>(groups_.size()),
                 static_cast<std::uint32_t>(frames_left_)},
                run_.engine.inbox().hellos());
}

bool FilmPictures::expects(const wire::Strip& strip, bool is_drawn) const {
  return strip.cut == 0 && groups_[number_of_group(strip.node)].writes() == is_drawn;
}

void FilmPictures::take_strip(StripMessage strip) {
  charge(wire::Work::host_strip, 1);
  if (watch_ != nullptr) watch_->receive(strip.header(), run_.engine.seconds());
  group_of(strip.header().node).receive(std::move(strip));
}

// Pastes what came of one frame, if it can be.
bool FilmPictures::compose() {
  ScopedSpan span(trace::HostSpan::compose);
  if (watch_ != nullptr) follow_first_busy();
  for (GroupWork& group : groups_) {
    const auto composed = group.compose(run_.sinks, run_.engine.store(), paste_listener_);
    if (!composed) continue;
    span.set_value(composed->pasted.number);
    charge(wire::Work::host_run, composed->counts.runs);
    charge(wire::Work::host_byte, composed->counts.bytes);
    charge(wire::Work::host_restored, composed->counts.restored);
    for (const NodeSlot& slot : composed->pasted.free) run_.engine.give(slot);
    if (composed->pasted.whole != nullptr) submit(*composed);
    return true;
  }
  span.forget();
  return false;
}

// The picture of the first group that has work is watched.
void FilmPictures::follow_first_busy() {
  const auto busy = std::ranges::find_if(groups_, [](const GroupWork& group) { return group.tasks() > 0; });
  const auto first = static_cast<std::uint32_t>(busy - groups_.begin());
  if (busy == groups_.end() || first == followed_) return;
  followed_ = first;
  watch_->follow(first);
}

void FilmPictures::show(const StripMessage& strip, const compositor::Compositor& compositor,
                        const compositor::Frame& frame) {
  watch_->paste(number_of_group(strip.header().node),
                {strip.header(), strip.constant_runs(), strip.moving_runs(), strip.edge_boxes()}, compositor, frame,
                run_.engine.seconds());
}

// A buffer for a frame that is being drawn.
bool FilmPictures::prepare() {
  ScopedSpan span(trace::HostSpan::prepare);
  if (std::ranges::any_of(groups_, [&](GroupWork& group) { return !group.writes() && group.prepare(run_.sinks); }))
    return true;
  span.forget();
  return false;
}

FinishedFrame FilmPictures::finished(const GroupWork::Composed& composed) {
  const Assembly::Pasted& frame = composed.pasted;
  const FinishedFrame finished{frame.number,   composed.interval, frame.kind, run_.engine.seconds(),
                               composed.given, frame.first_node,  frame.nodes};
  if (run_.options.each_frame) run_.report.frames.push_back(finished);
  --frames_left_;
  return finished;
}

void FilmPictures::submit(const GroupWork::Composed& composed) {
  compositor::Frame* const whole = composed.pasted.whole;
  const FinishedFrame frame = finished(composed);
  with_sinks_[frame.number] = frame;
  charge(wire::Work::host_frame, 1);
  if (watch_ != nullptr)
    watch_->compose({*whole, frame.interval, frame.kind, number_of_group(frame.first_node), frame.given, frame.seconds,
                     frame.first_node});
  run_.sinks.submit(whole);
}

void FilmPictures::note_with_sinks() {
  for (const sinks::SinkPool::Taken& taken : run_.sinks.taken()) {
    run_.engine.tracing().taken(taken);
    run_.report.sink_seconds += taken.ended - taken.begun;
    const auto found = with_sinks_.find(taken.number);
    if (run_.listener.finished) run_.listener.finished(found->second);
    with_sinks_.erase(found);
  }
}

void FilmPictures::take_drawn(const wire::Strip& drawn) {
  finish_written(group_of(drawn.node).note_drawn(drawn.frame));
}

bool FilmPictures::take_written(const wire::Written& written) {
  const auto group = std::ranges::find_if(
      groups_, [&](const GroupWork& each) { return each.writes() && each.awaits_file(written.frame); });
  if (group == groups_.end()) return false;
  run_.options.writing->written(written);
  run_.report.sink_seconds += written.seconds;
  storing_.add(run_.engine.seconds() - written.seconds, run_.engine.seconds());
  ++run_.report.node_files;
  finish_written(group->note_written(written.frame));
  return true;
}

void FilmPictures::finish_written(const std::optional<GroupWork::Composed>& frame) {
  if (!frame) return;
  const FinishedFrame whole = finished(*frame);
  if (run_.listener.finished) run_.listener.finished(whole);
}

void FilmPictures::warn(const std::string& text) {
  if (run_.listener.warned) run_.listener.warned(text);
}

void FilmPictures::charge(wire::Work kind, std::uint64_t units) {
  messages::charge(static_cast<int>(kind), units);
  run_.report.charged[static_cast<std::size_t>(kind) - wire::kNodeKinds] += units;
}

}  // namespace mars::farm
