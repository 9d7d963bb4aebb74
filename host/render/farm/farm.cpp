#include "host/render/farm/farm.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <optional>
#include <unordered_map>

#include "hal/messages/process.h"
#include "hal/nx/nx_messages.h"
#include "host/render/farm/film_loading.h"
#include "host/render/farm/group_work.h"
#include "host/render/farm/node_inbox.h"
#include "host/render/farm/shares.h"
#include "host/render/farm/tracing.h"
#include "host/render/farm/watching.h"
#include "node/color/encoding.h"
#include "node/wire/work.h"

namespace mars::farm {
namespace {

// That a node took itself, without waiting for the host.
double own_seconds(const wire::PhaseTimes& times) {
  return times.dice + times.sum + times.map + times.exchange + times.fill + times.scanline + times.depth +
         times.compose;
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

class Farm {
 public:
  Farm(std::span<const std::byte> film_block, const Plan& plan, const FarmOptions& options, sinks::SinkPool& sinks,
       const FarmListener& listener);
  ~Farm();
  Farm(const Farm&) = delete;
  Farm& operator=(const Farm&) = delete;

  FarmReport run();

 private:
  bool shake_hands();
  bool load_film();
  void choose_writers(const Writing& writing);
  NodeMemory node_memory() const;
  void render();
  bool work_once();
  void stop_nodes();

  void give_tasks();
  void give_when_asked();
  void give(GroupWork& to);
  void give_portion(GroupWork& to);
  void note_given(const collectives::Group& group, const std::vector<Standing>& before, const Portion& portion);
  void adapt(const wire::Strip& last, GroupWork& by);
  void report_slow_nodes();
  void receive();
  bool receive_strip(bool probed);
  void receive_drawn();
  void receive_written();
  GroupWork& group_that_wants(const wire::Strip& strip, bool is_drawn);
  void note_last(const wire::Strip& strip, GroupWork& by);
  void finish_written(const std::optional<GroupWork::Composed>& frame);
  FinishedFrame finished(const GroupWork::Composed& composed);
  bool prepare_one();
  bool compose_one();
  void submit(const GroupWork::Composed& composed);
  void note_taken();
  void charge(wire::Work kind, std::uint64_t units);
  std::optional<std::uint32_t> drawn_by(int node, std::int32_t begun) const;
  void finish_sinks();
  bool cancelled() const { return options_.cancellation != nullptr && options_.cancellation->cancelled(); }

  std::span<const std::byte> film_block_;
  const wire::FilmView film_;
  const Plan& plan_;
  const FarmOptions& options_;
  sinks::SinkPool& sinks_;
  const FarmListener& listener_;
  Heartbeats* const heartbeats_;  // may be nullptr
  NodeSlots slots_;
  NodeInbox inbox_;
  std::optional<Tracing> tracing_;  // once all nodes are there
  Watching watching_;
  FarmReport report_;

  std::vector<GroupWork> groups_;
  NodeRates rates_;
  std::size_t next_task_ = 0;
  std::unordered_map<std::uint32_t, FinishedFrame> with_sinks_;
  StripStore store_;
  std::size_t frames_left_;
  double start_ = 0;
};

Farm::Farm(std::span<const std::byte> film_block, const Plan& plan, const FarmOptions& options, sinks::SinkPool& sinks,
           const FarmListener& listener)
    : film_block_(film_block),
      film_(film_block, "film"),
      plan_(plan),
      options_(options),
      sinks_(sinks),
      listener_(listener),
      heartbeats_(options.heartbeats),
      slots_(static_cast<int>(numnodes()), options.credits),
      inbox_(sinks.shape().width, sinks.shape().height, sinks.shape().format, slots_, options.cancellation,
             options.watch != nullptr),
      watching_(options.watch, plan.groups),
      rates_(static_cast<std::size_t>(numnodes())),
      frames_left_(plan.frames()) {
  for (const collectives::Group& group : plan.groups)
    groups_.emplace_back(group, plan.contributors_of(group), sinks.shape());
  if (heartbeats_ != nullptr)
    heartbeats_->ask_for_drawing([this](int node, std::int32_t begun) { return drawn_by(node, begun); });
}

Farm::~Farm() {
  if (heartbeats_ != nullptr) heartbeats_->ask_for_drawing({});
}

FarmReport Farm::run() {
  if (shake_hands() && load_film()) render();
  stop_nodes();
  report_.cancelled = frames_left_ > 0;
  return std::move(report_);
}

bool Farm::shake_hands() {
  if (heartbeats_ != nullptr) heartbeats_->set_doing("waiting for nodes");
  if (!inbox_.receive_hellos()) return false;
  report_.nodes = inbox_.hellos();
  if (heartbeats_ != nullptr) heartbeats_->watch(report_.nodes);
  if (listener_.booted) listener_.booted(report_.nodes, plan_.keyframes(), plan_.inbetweens());
  return true;
}

bool Farm::load_film() {
  const double booted = dclock();
  tracing_.emplace(options_.trace, inbox_);
  wire::Load load{};
  report_.node_memory = node_memory();
  load.memory = report_.node_memory.frames;
  load.still_memory = report_.node_memory.still;
  load.credits = options_.credits;
  load.mapping = options_.mapping;
  load.groups = static_cast<std::int32_t>(groups_.size());
  load.pixel_format = sinks_.shape().format;
  load.traced = options_.trace != nullptr ? 1 : 0;
  load.watched = options_.watch != nullptr ? 1 : 0;
  report_.film_bytes = film_block_.size();
  const Writing* const writing = options_.writing;
  const bool nodes_write = writing != nullptr && (!writing->is_wanted || writing->is_wanted(report_.nodes));
  const bool loaded =
      farm::load_film(film_block_, load, inbox_, nodes_write ? writing->orders : std::span<const std::byte>());
  if (loaded && nodes_write) choose_writers(*writing);
  if (loaded) slots_.give_all();
  if (loaded && listener_.warned) std::ranges::for_each(inbox_.apart(), listener_.warned);
  report_.load_seconds = dclock() - booted;
  return loaded;
}

void Farm::choose_writers(const Writing& writing) {
  const std::string warning =
      farm::choose_writers(groups_, report_.nodes, writing, [this](int first) { return inbox_.sees_folder(first); });
  if (!warning.empty() && listener_.warned) listener_.warned(warning);
}

NodeMemory Farm::node_memory() const {
  std::uint64_t bytes = options_.memory;
  if (bytes == 0) bytes = std::ranges::min(inbox_.hellos(), {}, &wire::Hello::memory).memory;
  return share_node_memory(bytes, options_.still_memory, wire::FilmView(film_block_, "film").settings());
}

void Farm::render() {
  start_ = dclock();
  watching_.begin({film_, sinks_.shape().block, sinks_.shape().format, static_cast<std::uint32_t>(groups_.size()),
                   static_cast<std::uint32_t>(frames_left_)},
                  report_.nodes);
  if (heartbeats_ != nullptr) heartbeats_->set_doing("rendering");
  while (frames_left_ > 0 && !cancelled()) {
    if (heartbeats_ != nullptr) heartbeats_->look();
    give_tasks();
    note_taken();
    tracing_->drain();
    const double begun = dclock();
    if (work_once())
      report_.busy_seconds += dclock() - begun;
    else
      flick();
  }
  report_.render_seconds = dclock() - start_;
  report_.slow_times = rates_.slow_times();
  if (frames_left_ > 0) return;
  const ScopedSpan span(trace::HostSpan::finish);
  finish_sinks();
  note_taken();
  report_.files = sinks_.made();
  report_.total_seconds = dclock() - start_;
}

void Farm::finish_sinks() {
  if (heartbeats_ == nullptr) return sinks_.finish();
  heartbeats_->during("waiting for storage", [this] { sinks_.finish(); });
}

std::optional<std::uint32_t> Farm::drawn_by(int node, std::int32_t begun) const {
  const auto has = [node](const GroupWork& work) {
    return node >= work.group().first && node < work.group().first + work.group().count;
  };
  const auto work = std::ranges::find_if(groups_, has);
  return work == groups_.end() ? std::nullopt : work->drawn_by(node, begun);
}

// Whether there was something to do.
bool Farm::work_once() {
  if (compose_one() || receive_strip(false)) return true;
  if (!iprobe(wire::any_of(wire::kStrip, wire::kFault, wire::kTrace, wire::kDrawn, wire::kWritten, wire::kStorage)))
    return prepare_one();
  receive();
  return true;
}

void Farm::charge(wire::Work kind, std::uint64_t units) {
  messages::charge(static_cast<int>(kind), units);
  report_.charged[static_cast<std::size_t>(kind) - wire::kNodeKinds] += units;
}

// Nodes that still draw then send no more strips, and end when the keyframes they were given are drawn.
void Farm::stop_nodes() {
  if (tracing_ && frames_left_ == 0) tracing_->read_clocks_again();
  if (heartbeats_ != nullptr) heartbeats_->forget_nodes();
  for (long node = 0; node < numnodes(); ++node) csend(wire::kStop, nullptr, 0, node, 0);
  if (tracing_) tracing_->finish();
}

void Farm::give_tasks() {
  if (listener_.more) return give_when_asked();
  // Every group gets its first before any gets one ahead: there may be few.
  for (std::size_t ahead = 1; ahead <= kTasksAhead; ++ahead)
    for (GroupWork& group : groups_)
      if (!group.is_open() && group.tasks() < ahead && next_task_ < plan_.tasks.size()) give(group);
}

void Farm::give_when_asked() {
  if (groups_.front().tasks() > 0 || !with_sinks_.empty() || next_task_ == plan_.tasks.size()) return;
  if (listener_.more())
    give(groups_.front());
  else
    frames_left_ = 0;
}

void Farm::give(GroupWork& to) {
  const double given = dclock() - start_;
  const Task& task = plan_.tasks[next_task_++];
  to.give(task, background_pixel(film_, film_.intervals()[task.interval], sinks_.shape().format), given);
  give_portion(to);
}

void Farm::give_portion(GroupWork& to) {
  const Task& task = to.open_task();
  const ScopedSpan span(trace::HostSpan::give, task.interval);
  const collectives::Group& group = to.group();
  const std::vector<Standing> before = to.standings(rates_);
  const Portion portion =
      to.give_portion(before, options_.adapts ? kTurnsInPortion * before.size() : task.frames.size());
  const std::vector<std::byte> message = render_command(task, portion, group, to.contributors());
  for (int node = group.first; node < group.first + group.count; ++node)
    csend(wire::kRender, message.data(), static_cast<long>(message.size()), node, 0);
  note_given(group, before, portion);
}

// Nodes that had nothing left of a task that goes on were idle until now.
void Farm::note_given(const collectives::Group& group, const std::vector<Standing>& before, const Portion& portion) {
  const double now = dclock() - start_;
  for (std::size_t member = 0; member < before.size(); ++member) {
    const int node = group.first + static_cast<int>(member);
    if (portion.first > 0 && before[member].waiting == 0) rates_.ready(node, now);
    if (!portion.cycle.empty())
      rates_.given(node, std::ranges::count(portion.cycle, static_cast<std::int32_t>(member)) > 0);
  }
}

void Farm::receive() {
  switch (infotype()) {
    case wire::kFault: inbox_.receive_fault();
    case wire::kTrace: tracing_->receive(); break;
    case wire::kDrawn: receive_drawn(); break;
    case wire::kWritten: receive_written(); break;
    case wire::kStorage: {
      const std::string warning = inbox_.receive_storage_warning();
      if (listener_.warned) listener_.warned(warning);
      break;
    }
    default: receive_strip(true);
  }
}

// The one that was probed, or one whose bytes were on their way until now; whether there is one.
bool Farm::receive_strip(bool probed) {
  ScopedSpan span(trace::HostSpan::strip);
  std::optional<StripMessage> strip = probed ? inbox_.receive_strip(store_) : inbox_.finished_strip();
  if (!strip) {
    span.forget();
    return false;
  }
  const wire::Strip header = strip->header();
  charge(wire::Work::host_strip, 1);
  span.set_value(header.frame);
  GroupWork& group = group_that_wants(header, false);
  watching_.receive(header);
  group.receive(std::move(*strip));
  if (header.last == 1) note_last(header, group);
  return true;
}

// `is_drawn`: it has no pixels, for the nodes write the frame.
GroupWork& Farm::group_that_wants(const wire::Strip& strip, bool is_drawn) {
  const auto wanting = std::ranges::find_if(
      groups_, [&](const GroupWork& group) { return group.writes() == is_drawn && group.wants(strip); });
  if (wanting == groups_.end())
    inbox_.refuse(strip.node, "a strip of frame " + std::to_string(strip.frame) + " that it was not asked for");
  if (heartbeats_ != nullptr) heartbeats_->hear(strip);
  return *wanting;
}

void Farm::note_last(const wire::Strip& strip, GroupWork& by) {
  if (options_.each_frame) report_.strips.push_back(strip);
  if (options_.adapts) adapt(strip, by);
}

void Farm::receive_drawn() {
  const wire::Strip drawn = inbox_.receive_drawn();
  GroupWork& group = group_that_wants(drawn, true);
  const auto whole = group.note_drawn(drawn);
  note_last(drawn, group);
  finish_written(whole);
}

void Farm::receive_written() {
  const wire::Written written = inbox_.receive_written();
  const auto group = std::ranges::find_if(
      groups_, [&](const GroupWork& each) { return each.writes() && each.awaits_file(written.frame); });
  if (group == groups_.end()) inbox_.refuse(written.node, "word of a file that it was not asked for");
  options_.writing->written(written);
  report_.sink_seconds += written.seconds;
  finish_written(group->note_written(written.frame));
}

void Farm::finish_written(const std::optional<GroupWork::Composed>& frame) {
  if (!frame) return;
  const FinishedFrame whole = finished(*frame);
  --frames_left_;
  if (listener_.finished) listener_.finished(whole);
}

// To a node's last strip of a frame. Nodes begin with inbetweens when the keyframe is there.
void Farm::adapt(const wire::Strip& last, GroupWork& by) {
  const double now = dclock() - start_;
  if (last.kind == wire::FrameKind::keyframe) {
    const collectives::Group& group = by.group();
    for (int node = group.first; node < group.first + group.count; ++node) rates_.ready(node, now);
    return;
  }
  rates_.came(last.node, now, own_seconds(last.times), work_of(last.work));
  report_slow_nodes();
  if (by.is_open() && runs_short(by.standings(rates_))) give_portion(by);
}

void Farm::report_slow_nodes() {
  for (const int node : rates_.take_changed()) {
    const double slowness = rates_.slowness(node);
    if (listener_.warned) listener_.warned(slow_text(inbox_.name_of(node), slowness));
    if (listener_.slowed) listener_.slowed(node, slowness);
  }
}

// While nothing comes: a buffer for a frame that is being drawn; whether there was one to prepare.
bool Farm::prepare_one() {
  ScopedSpan span(trace::HostSpan::prepare);
  if (std::any_of(groups_.begin(), groups_.end(),
                  [&](GroupWork& group) { return !group.writes() && group.prepare(sinks_); }))
    return true;
  span.forget();
  return false;
}

// Pastes what came of one frame, if it can be; whether it did.
bool Farm::compose_one() {
  ScopedSpan span(trace::HostSpan::compose);
  watching_.follow(groups_);
  for (GroupWork& group : groups_) {
    const auto composed = group.compose(sinks_, store_, watching_.listener());
    if (!composed) continue;
    span.set_value(composed->pasted.number);
    charge(wire::Work::host_run, composed->counts.runs);
    charge(wire::Work::host_byte, composed->counts.bytes);
    charge(wire::Work::host_restored, composed->counts.restored);
    for (const NodeSlot& slot : composed->pasted.free) slots_.give(slot);
    if (composed->pasted.whole != nullptr) submit(*composed);
    return true;
  }
  span.forget();
  return false;
}

FinishedFrame Farm::finished(const GroupWork::Composed& composed) {
  const Assembly::Pasted& frame = composed.pasted;
  const FinishedFrame finished{frame.number,   composed.interval, frame.kind, dclock() - start_,
                               composed.given, frame.first_node,  frame.nodes};
  if (options_.each_frame) report_.frames.push_back(finished);
  return finished;
}

void Farm::submit(const GroupWork::Composed& composed) {
  const Assembly::Pasted& frame = composed.pasted;
  const FinishedFrame finished = this->finished(composed);
  with_sinks_[frame.number] = finished;
  charge(wire::Work::host_frame, 1);
  watching_.compose(
      {*frame.whole, finished.interval, finished.kind, 0, finished.given, finished.seconds, frame.first_node});
  sinks_.submit(frame.whole);
  --frames_left_;
}

void Farm::note_taken() {
  for (const sinks::SinkPool::Taken& taken : sinks_.taken()) {
    tracing_->taken(taken);
    report_.sink_seconds += taken.ended - taken.begun;
    const auto found = with_sinks_.find(taken.number);
    if (listener_.finished) listener_.finished(found->second);
    with_sinks_.erase(found);
  }
}

}  // namespace

std::uint64_t background_pixel(const wire::FilmView& film, const wire::Interval& interval, wire::PixelFormat format) {
  const wire::FilmSettings& settings = film.settings();
  const auto encoding = color::encoding_of(settings, film.camera_at(interval.first_frame), format);
  return color::pixel_of(encoding, settings.background.data());
}

FarmReport render_film(std::span<const std::byte> film_block, const Plan& plan, const FarmOptions& options,
                       sinks::SinkPool& sinks, const FarmListener& listener) {
  return Farm(film_block, plan, options, sinks, listener).run();
}

void dismiss_nodes() {
  NodeSlots slots(static_cast<int>(numnodes()), 1);
  NodeInbox(1, 1, wire::PixelFormat::rgb8, slots, nullptr).receive_hellos();
  for (long node = 0; node < numnodes(); ++node) csend(wire::kStop, nullptr, 0, node, 0);
}

}  // namespace mars::farm
