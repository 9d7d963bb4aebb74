#include "host/experiments/forecast/rehearsal.h"

#include <algorithm>
#include <array>
#include <deque>
#include <functional>
#include <map>
#include <utility>

#include "hal/simulated/routes.h"
#include "host/experiments/forecast/clockwork.h"
#include "host/experiments/forecast/computers.h"
#include "host/experiments/forecast/frame_costs.h"
#include "host/experiments/forecast/host_side.h"

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

  // `then` happens to the node when it has worked so long.
  void work(int n, double seconds, void (Rehearsal::*then)(int));
  void later(int n, double time, void (Rehearsal::*then)(int)) {
    clockwork_.at(time, [this, n, then] { (this->*then)(n); });
  }
  double way_from_host(int n, double bytes) {
    return routes_.arrival(computers_.of(static_cast<int>(nodes_.size())), computers_.of(n),
                           static_cast<std::size_t>(bytes), clockwork_.now(), clockwork_.now());
  }

  const FilmCounts& counts_;
  const farm::Plan& plan_;
  const FrameCosts costs_;
  Clockwork clockwork_;
  Computers computers_;
  simulated::Routes routes_;
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
      costs_(setting),
      computers_(setting.platform.machine, nodes),
      routes_(setting.platform.machine.network, computers_.count(), computers_.of(nodes)),
      nodes_(static_cast<std::size_t>(nodes)),
      result_{0, {}, 0, 0, 0, host_memory(plan, setting, nodes)},
      host_(
          clockwork_, computers_, plan, setting, result_.host_memory, nodes,
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
  std::vector<double> backgrounds;
  for (const wire::FrameCounts& keyframe : counts.keyframes) backgrounds.push_back(costs_.background(keyframe));
  for (const TaskCounts& task : counts.tasks) host_.add_background(backgrounds[task.keyframe]);
  const int in_a_group = plan.groups.front().count;
  for (const TaskCounts& task : counts.tasks) {
    std::vector<NodePart>& parts = inbetweens_.emplace_back();
    for (const FrameTotals& totals : task.inbetweens)
      parts.push_back(costs_.inbetween(totals, counts.keyframes[task.keyframe], in_a_group));
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
  work(n, part_of(node).dice + fresh_seconds(node), &Rehearsal::sum);
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
  result_.bytes_to_host += part.strips.bytes;
  result_.node_memory = std::max(result_.node_memory, part.memory);
  draw_strip(n);
}

void Rehearsal::draw_strip(int n) {
  Node& node = nodes_[static_cast<std::size_t>(n)];
  if (node.strips_left == 0) return finish_strip(n);
  if (node.slots == 0) {
    node.waits_for_slot = true;
    return;
  }
  --node.slots;
  const StripCosts& strips = part_of(node).strips;
  work(n, strips.seconds / strips.count, &Rehearsal::finish_strip);
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
  if (node.strips_left == 0) return end_frame(n);  // it does not contribute
  const StripCosts& strips = part_of(node).strips;
  const auto host = static_cast<int>(nodes_.size());
  const bool same_computer = computers_.of(n) == computers_.of(host);
  const double bytes = same_computer ? kOnTheSameComputer : strips.bytes / strips.count;
  const StripSent strip{n, node.task, node.frame, bytes, strips.pasting / strips.count, --node.strips_left == 0};
  const double sent = computers_.work(n, clockwork_.now(), costs_.costs().to_send(bytes));
  clockwork_.at(sent, [this, strip, host] {
    const double arrival = routes_.arrival(computers_.of(strip.node), computers_.of(host),
                                           static_cast<std::size_t>(strip.bytes), clockwork_.now(), clockwork_.now());
    clockwork_.at(arrival, [this, strip] { host_.arrive(strip); });
  });
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
  work(n, part.dice + part.exchange + fresh_seconds(node), &Rehearsal::begin_strips);
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
