#include "host/experiments/forecast/rehearsal.h"

#include <algorithm>
#include <array>
#include <deque>
#include <functional>
#include <map>
#include <utility>

#include "hal/simulated/routes.h"
#include "hal/simulated/storage_use.h"
#include "host/experiments/forecast/clockwork.h"
#include "host/experiments/forecast/computers.h"
#include "host/experiments/forecast/frame_costs.h"
#include "host/experiments/forecast/host_side.h"
#include "node/wire/frame_writer.h"

namespace mars::forecast {
namespace {

constexpr double kOnTheSameComputer = sizeof(wire::Strip);  // of a strip whose pixels the host reads where they lie

class Rehearsal {
 public:
  Rehearsal(const FilmCounts& counts, const farm::Plan& plan, const Setting& setting, int nodes);

  Rehearsed run();

 private:
  struct Node {
    std::size_t group = 0;
    int member = 0;
    int slots = 0;
    bool waits_for_slot = false;
    bool idle = true;
    std::size_t files = 0;          // under way
    double file_there = 0;          // seconds, when the last of them will be
    bool waits_for_file = false;    // to be able to begin another
    std::deque<std::size_t> tasks;  // given and not begun
    std::size_t task = 0;
    std::size_t frame = 0;  // of the task that it draws
    std::uint32_t strips_left = 0;
    double memory = 0;                        // bytes that it used so far
    const GroupKeyframe* keyframe = nullptr;  // of the task
  };
  struct GroupState {
    collectives::Group nodes;
    int come = 0;  // of its nodes, to where all wait
  };

  const GroupKeyframe& keyframe_of(std::size_t task, const collectives::Group& group);
  const NodePart& part_of(const Node& node);
  double fresh_seconds(Node& node);
  void receive_task(std::size_t group, std::size_t task);
  void begin_task(int n);
  void wait_for_all(int n, const std::function<double(int)>& wait, void (Rehearsal::*then)(int));
  void sum(int n);
  void exchange(int n);
  void begin_strips(int n);
  void draw_strip(int n);
  void finish_strip(int n);
  void wait_for_group(int n);
  void send_strip(int n);
  void end_frame(int n);
  void receive_credit(int n);
  void finish_drawing(int n);
  void exchange_bands(int n);
  void wait_for_bands(int n);
  void write_file(int n);
  void begin_file(int n);
  void end_file(int n, std::size_t task, std::size_t frame);
  void send_to_host(StripSent message);
  bool writes(const Node& node) const;

  // The node draws and composes: idle nodes may help.
  double drawing(int n, double seconds);
  // `then` happens to the node when it has worked so long.
  void work(int n, double seconds, void (Rehearsal::*then)(int));
  void later(int n, double time, void (Rehearsal::*then)(int)) {
    clockwork_.at(time, [this, n, then] { (this->*then)(n); });
  }
  double way_from_host(int n, double bytes) {
    if (!costs_.costs().takes_time(wire::kStrip)) return clockwork_.now();
    return routes_.arrival(computers_.of(static_cast<int>(nodes_.size())), computers_.of(n),
                           static_cast<std::size_t>(bytes), clockwork_.now(), clockwork_.now());
  }

  const FilmCounts& counts_;
  const farm::Plan& plan_;
  const FrameCosts costs_;
  Clockwork clockwork_;
  Computers computers_;
  simulated::Routes routes_;
  simulated::StorageUse storage_;
  const bool nodes_write_;
  const std::vector<walls::Pace> paces_;
  std::map<std::array<std::size_t, 3>, GroupKeyframe> keyframes_;  // by number, nodes and inbetweens
  std::vector<std::vector<NodePart>> inbetweens_;                  // by task
  std::vector<Node> nodes_;
  std::vector<GroupState> groups_;
  Rehearsed result_;
  HostSide host_;
};

farm::HostMemory host_memory(const farm::Plan& plan, const Setting& setting, int nodes) {
  return farm::share_host_memory(setting.host_budget, setting.film.settings(), setting.pixels(),
                                 static_cast<std::uint32_t>(nodes), static_cast<std::uint32_t>(plan.groups.size()),
                                 setting.sink_threads);
}

Rehearsal::Rehearsal(const FilmCounts& counts, const farm::Plan& plan, const Setting& setting, int nodes)
    : counts_(counts),
      plan_(plan),
      costs_(setting, nodes),
      computers_(setting.platform.machine, nodes),
      routes_(setting.platform.machine.network, computers_.count(), computers_.of(nodes)),
      storage_(setting.platform.machine.storage, setting.platform.machine.network),
      nodes_write_(setting.nodes_write()),
      paces_(setting.even.paces),
      nodes_(static_cast<std::size_t>(nodes)),
      result_{0,
              {},
              0,
              0,
              0,
              costs_.shadow_bytes(),
              0,
              host_memory(plan, setting, nodes),
              std::vector<walls::Busy>(nodes_.size())},
      host_(
          clockwork_, computers_, storage_, plan, setting, result_.host_memory, nodes,
          {[this](std::size_t group, std::size_t task) { receive_task(group, task); },
           [this](int node) { later(node, way_from_host(node, sizeof(wire::Credit)), &Rehearsal::receive_credit); }}) {
  for (std::size_t g = 0; g < plan.groups.size(); ++g) {
    groups_.push_back({plan.groups[g]});
    for (int member = 0; member < plan.groups[g].count; ++member) {
      Node& node = nodes_[static_cast<std::size_t>(plan.groups[g].first + member)];
      node.group = g;
      node.member = member;
      node.slots = result_.host_memory.credits;
    }
  }
  for (const TaskCounts& task : counts.tasks) host_.add_costs(costs_.host_costs(task, counts.keyframes[task.keyframe]));
  for (const TaskCounts& task : counts.tasks)
    if (!task.inbetweens.empty())
      result_.still_memory = std::max(result_.still_memory,
                                      costs_.still_bytes(counts.keyframes[task.keyframe], plan.groups.front().count));
  std::vector<FrameTotals> again;
  for (const wire::FrameCounts& keyframe : counts.keyframes)
    again.push_back(costs_.drawn_again(keyframe, plan.groups.front().count));
  for (const TaskCounts& task : counts.tasks) {
    std::vector<NodePart>& parts = inbetweens_.emplace_back();
    for (const FrameTotals& totals : task.inbetweens) parts.push_back(costs_.inbetween(totals, again[task.keyframe]));
  }
}

Rehearsed Rehearsal::run() {
  host_.begin();
  clockwork_.run();
  result_.seconds = host_.ended();
  result_.frames = std::move(host_.frames());
  return std::move(result_);
}

const GroupKeyframe& Rehearsal::keyframe_of(std::size_t task, const collectives::Group& group) {
  const std::size_t number = counts_.tasks[task].keyframe;
  const auto size = static_cast<std::size_t>(group.count);
  const std::size_t inbetweens = std::min(size, counts_.tasks[task].inbetweens.size());
  const auto [found, fresh] = keyframes_.try_emplace({number, size, inbetweens});
  if (fresh)
    found->second = costs_.keyframe(counts_.keyframes[number], group.count, plan_.contributors_of(group), inbetweens);
  return found->second;
}

const NodePart& Rehearsal::part_of(const Node& node) {
  if (node.frame > 0) return inbetweens_[node.task][node.frame - 1];
  return node.keyframe->nodes[static_cast<std::size_t>(node.member)];
}

// Of a frame that the node begins: its first, or one that takes more memory than any before.
double Rehearsal::fresh_seconds(Node& node) {
  const double memory = part_of(node).made_memory;
  const double first = node.memory == 0 ? costs_.costs().of(wire::Work::first_frame, 1) : 0;
  const double before = std::exchange(node.memory, std::max(node.memory, memory));
  return first + costs_.costs().of(wire::Work::fresh_byte, node.memory - before);
}

void Rehearsal::receive_task(std::size_t group, std::size_t task) {
  const collectives::Group& nodes = groups_[group].nodes;
  const auto bytes = static_cast<double>(farm::render_command(plan_.tasks[task], nodes, 1).size());
  const double each = costs_.costs().host_to_send(bytes);
  for (int member = 0; member < nodes.count; ++member) {
    const int n = nodes.first + member;
    clockwork_.at(way_from_host(n, bytes) + (member + 1) * each, [this, n, task] {
      Node& node = nodes_[static_cast<std::size_t>(n)];
      node.tasks.push_back(task);
      if (std::exchange(node.idle, false)) begin_task(n);
    });
  }
}

void Rehearsal::work(int n, double seconds, void (Rehearsal::*then)(int)) {
  later(n, computers_.work(n, clockwork_.now(), seconds), then);
}

double Rehearsal::drawing(int n, double seconds) {
  const auto number = static_cast<std::size_t>(n);
  const auto [busy, pace] = nodes_[number].frame == 0 ? std::pair(&walls::Busy::keyframes, &walls::Pace::keyframes)
                                                      : std::pair(&walls::Busy::inbetweens, &walls::Pace::inbetweens);
  result_.busy[number].*busy += seconds;
  return paces_.empty() ? seconds : seconds * paces_[number].*pace;
}

void Rehearsal::begin_task(int n) {
  Node& node = nodes_[static_cast<std::size_t>(n)];
  if (node.tasks.empty()) {
    node.idle = true;
    return;
  }
  node.task = node.tasks.front();
  node.tasks.pop_front();
  node.frame = 0;
  node.keyframe = &keyframe_of(node.task, groups_[node.group].nodes);
  work(n, drawing(n, part_of(node).dice + fresh_seconds(node)), &Rehearsal::sum);
}

// Once all nodes of the group have come, each goes on after its own wait.
void Rehearsal::wait_for_all(int n, const std::function<double(int)>& wait, void (Rehearsal::*then)(int)) {
  GroupState& group = groups_[nodes_[static_cast<std::size_t>(n)].group];
  if (++group.come < group.nodes.count) return;
  group.come = 0;
  for (int node = group.nodes.first; node < group.nodes.first + group.nodes.count; ++node)
    later(node, clockwork_.now() + wait(node), then);
}

void Rehearsal::sum(int n) {
  const GroupKeyframe& keyframe = *nodes_[static_cast<std::size_t>(n)].keyframe;
  if (keyframe.nodes.size() == 1) return exchange(n);
  wait_for_all(
      n, [&](int) { return keyframe.sum; }, &Rehearsal::exchange);
}

void Rehearsal::exchange(int n) {
  const NodePart& part = part_of(nodes_[static_cast<std::size_t>(n)]);
  const double end = computers_.work(n, clockwork_.now(), part.exchange);
  later(n, std::max(end, clockwork_.now() + part.exchange_wait), &Rehearsal::begin_strips);
}

void Rehearsal::begin_strips(int n) {
  Node& node = nodes_[static_cast<std::size_t>(n)];
  const NodePart& part = part_of(node);
  node.strips_left = part.strips.count;
  result_.bytes_to_nodes += node.frame == 0 ? part.bytes_to_nodes : 0;
  result_.bytes_to_host += nodes_write_ ? static_cast<double>(sizeof(wire::Strip)) : part.strips.bytes;
  result_.node_memory = std::max(result_.node_memory, part.memory);
  draw_strip(n);
}

void Rehearsal::draw_strip(int n) {
  Node& node = nodes_[static_cast<std::size_t>(n)];
  if (node.strips_left == 0) return finish_strip(n);
  if (nodes_write_) {
    node.strips_left = 0;
    const NodePart& part = part_of(node);
    return work(n, drawing(n, part.strips.seconds + part.compose), &Rehearsal::finish_strip);
  }
  if (node.slots == 0) {
    node.waits_for_slot = true;
    return;
  }
  --node.slots;
  const StripCosts& strips = part_of(node).strips;
  work(n, drawing(n, strips.seconds / strips.count), &Rehearsal::finish_strip);
}

// The last strip of a keyframe goes once the group's nodes have given each other what inbetweens need.
void Rehearsal::finish_strip(int n) {
  const Node& node = nodes_[static_cast<std::size_t>(n)];
  const bool several = node.keyframe->nodes.size() > 1;
  if (node.strips_left > 1 || node.frame > 0 || !several || inbetweens_[node.task].empty()) return send_strip(n);
  work(n, part_of(node).still, &Rehearsal::wait_for_group);
}

void Rehearsal::wait_for_group(int n) {
  wait_for_all(
      n, [this](int node) { return part_of(nodes_[static_cast<std::size_t>(node)]).still_wait; },
      &Rehearsal::send_strip);
}

void Rehearsal::send_strip(int n) {
  Node& node = nodes_[static_cast<std::size_t>(n)];
  if (nodes_write_) return exchange_bands(n);
  if (node.strips_left == 0) return end_frame(n);  // it does not contribute
  const StripCosts& strips = part_of(node).strips;
  const bool same_computer = computers_.of(n) == computers_.of(static_cast<int>(nodes_.size()));
  const double bytes = same_computer ? kOnTheSameComputer : strips.bytes / strips.count;
  const StripSent strip{n, node.task, node.frame, bytes, strips.pasting / strips.count, --node.strips_left == 0};
  const double sent = computers_.work(n, clockwork_.now(), costs_.costs().to_send_host(bytes));
  clockwork_.at(sent, [this, strip] { send_to_host(strip); });
  later(n, sent, strip.last ? &Rehearsal::end_frame : &Rehearsal::draw_strip);
}

void Rehearsal::end_frame(int n) {
  Node& node = nodes_[static_cast<std::size_t>(n)];
  const farm::Task& task = plan_.tasks[node.task];
  const auto count = static_cast<std::size_t>(groups_[node.group].nodes.count);
  // The next inbetween k whose number in the film has this node's turn.
  std::size_t k = node.frame;
  while (k < task.frames.size() - 1 && (task.first_inbetween + k) % count != static_cast<std::size_t>(node.member)) ++k;
  if (k == task.frames.size() - 1) return begin_task(n);
  node.frame = k + 1;
  const NodePart& part = part_of(node);
  work(n, drawing(n, part.dice + part.exchange + fresh_seconds(node)), &Rehearsal::begin_strips);
}

// On its way from now on.
void Rehearsal::send_to_host(StripSent message) {
  const auto host = static_cast<int>(nodes_.size());
  const double now = clockwork_.now();
  const bool takes_time = costs_.costs().takes_time(wire::kStrip);
  const double arrival = takes_time ? routes_.arrival(computers_.of(message.node), computers_.of(host),
                                                      static_cast<std::size_t>(message.bytes), now, now)
                                    : now;
  clockwork_.at(arrival, [this, message] { host_.arrive(message); });
}

// A keyframe's, after what inbetweens need else.
void Rehearsal::exchange_bands(int n) {
  const Node& node = nodes_[static_cast<std::size_t>(n)];
  if (node.frame > 0 || node.keyframe->nodes.size() == 1) return write_file(n);
  work(n, part_of(node).bands, &Rehearsal::wait_for_bands);
}

void Rehearsal::wait_for_bands(int n) {
  wait_for_all(
      n, [this](int node) { return part_of(nodes_[static_cast<std::size_t>(node)]).bands_wait; },
      &Rehearsal::write_file);
}

// Nodes of a group take turns in writing keyframes.
bool Rehearsal::writes(const Node& node) const {
  const collectives::Group& group = groups_[node.group].nodes;
  const auto turn =
      static_cast<int>(plan_.tasks[node.task].interval % static_cast<std::uint32_t>(plan_.contributors_of(group)));
  return node.frame > 0 || node.member == turn;
}

void Rehearsal::write_file(int n) {
  Node& node = nodes_[static_cast<std::size_t>(n)];
  if (!writes(node)) return end_frame(n);
  if (node.files < wire::kMostFilesUnderWay) return begin_file(n);
  node.waits_for_file = true;
}

void Rehearsal::begin_file(int n) {
  Node& node = nodes_[static_cast<std::size_t>(n)];
  ++node.files;
  const double begun = std::max(clockwork_.now(), node.file_there);
  const double made = std::max(begun, computers_.reserve(n, clockwork_.now(), costs_.writing()));
  node.file_there = storage_.write(made, costs_.file_bytes(), clockwork_.now());
  clockwork_.at(node.file_there, [this, n, task = node.task, frame = node.frame] { end_file(n, task, frame); });
  const auto drawn = static_cast<double>(sizeof(wire::Strip));
  send_to_host({n, node.task, node.frame, drawn, 0, true});
  work(n, costs_.costs().to_send_host(drawn), &Rehearsal::end_frame);
}

void Rehearsal::end_file(int n, std::size_t task, std::size_t frame) {
  Node& node = nodes_[static_cast<std::size_t>(n)];
  --node.files;
  send_to_host({n, task, frame, sizeof(wire::Written), 0, true, true});
  if (std::exchange(node.waits_for_file, false)) begin_file(n);
}

void Rehearsal::receive_credit(int n) {
  Node& node = nodes_[static_cast<std::size_t>(n)];
  ++node.slots;
  if (std::exchange(node.waits_for_slot, false)) draw_strip(n);
}

}  // namespace

Rehearsed rehearse(const FilmCounts& counts, const farm::Plan& plan, const Setting& setting, int nodes) {
  return Rehearsal(counts, plan, setting, nodes).run();
}

}  // namespace mars::forecast
