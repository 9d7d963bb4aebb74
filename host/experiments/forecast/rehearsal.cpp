#include "host/experiments/forecast/rehearsal.h"

#include <algorithm>
#include <array>
#include <deque>
#include <map>
#include <memory>
#include <utility>

#include "hal/simulated/computers.h"
#include "hal/simulated/routes.h"
#include "hal/simulated/storage_use.h"
#include "host/experiments/forecast/clockwork.h"
#include "host/experiments/forecast/exchanges.h"
#include "host/experiments/forecast/frame_costs.h"
#include "host/experiments/forecast/host_side.h"
#include "node/wire/frame_writer.h"

namespace mars::forecast {
namespace {

constexpr int kNone = -1;
constexpr double kOnTheSameComputer = sizeof(wire::Strip);  // of a strip whose pixels the host reads where they lie

struct TaskKeyframe {
  std::shared_ptr<const GroupKeyframe> drawn;
  KeyframeGifts gifts;
};

class Rehearsal {
 public:
  Rehearsal(const FilmCounts& counts, const farm::Plan& plan, const Setting& setting, int nodes, KeyframeLoads& loads);

  Rehearsed run(double limit);

 private:
  struct Node {
    std::size_t group = 0;
    int member = 0;
    std::uint64_t team = 0;        // of the group's
    collectives::Group of_team{};  // its nodes
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
    double exchange_began = 0;
    double memory = 0;                             // bytes that it used so far
    std::shared_ptr<const TaskKeyframe> keyframe;  // of the task
  };
  // How triangles come to the homes of their lines in a group (node/group/exchange_times.h).
  struct GroupExchange {
    std::size_t sent = 0;     // keyframes
    std::size_t made = 0;     // keyframes
    double sending = 0;       // seconds of all nodes, the last time but for the first
    double making = 0;        // so too
    bool again = false;       // in the current keyframe
    int begun = 0, come = 0;  // of its nodes
    double seconds = 0;
  };
  // An inbetween that a team draws, where nodes write files.
  struct TeamFrame {
    int come = 0;               // of other nodes' bands
    bool writer_waits = false;  // for them
  };

  int writer_of(std::size_t task, const KeyframeGroup& group);
  std::shared_ptr<const TaskKeyframe> keyframe_of(std::size_t task, const collectives::Group& group);
  std::shared_ptr<const GroupKeyframe> shared_keyframe(std::size_t number, const KeyframeGroup& group);
  const NodePart& part_of(const Node& node);
  const std::vector<std::vector<NodePart>>& inbetweens_of(int sharers);
  int writer_of(const Node& node) const;
  double next_part(const Node& node);
  double fresh_seconds(Node& node);
  void receive_task(std::size_t group, std::size_t task);
  void begin_task(int n);
  void exchange(int n, const Exchange& exchange, void (Rehearsal::*then)(int));
  void sum(int n);
  void map(int n);
  bool makes_again(const GroupKeyframe& keyframe, const GroupExchange& so_far) const;
  void exchange_triangles(int n);
  void end_exchange(int n);
  void begin_strips(int n);
  void draw_strip(int n);
  void finish_strip(int n);
  void send_strip(int n);
  void end_frame(int n);
  void receive_credit(int n);
  void finish_drawing(int n);
  void exchange_bands(int n);
  void exchange_team_bands(int n);
  void receive_team_bands(int writer, std::size_t task, std::size_t frame);
  void collect_team_bands(int n);
  void send_drawn(int n);
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
  double way_from_host(int n, double bytes);
  double answer(const StripSent& strip);

  const FilmCounts& counts_;
  const farm::Plan& plan_;
  KeyframeLoads& loads_;
  const FrameCosts costs_;
  Clockwork clockwork_;
  simulated::Computers computers_;
  simulated::Routes routes_;
  simulated::StorageUse storage_;
  const bool nodes_write_;
  const std::vector<walls::Pace> paces_;
  Exchanges exchanges_;
  // By number, nodes, place on a machine, whether inbetweens follow, and contributors. Those of exact counts are used
  // once.
  std::map<KeyframeLoads::Key, std::shared_ptr<const GroupKeyframe>> keyframes_;
  std::vector<std::weak_ptr<const TaskKeyframe>> task_keyframes_;
  std::vector<int> writers_;                                      // of keyframes, members of groups; by task
  std::map<int, std::size_t> keyframes_so_far_;                   // by a group's first node
  std::map<int, std::vector<std::vector<NodePart>>> inbetweens_;  // by nodes that share one, and by task
  std::vector<std::vector<TeamFrame>> team_frames_;               // by task
  std::vector<std::int32_t> teams_;                               // by group
  const wire::Exchange exchange_;
  std::vector<GroupExchange> group_exchanges_;  // by group
  std::vector<Node> nodes_;
  Rehearsed result_;
  HostSide host_;
};

farm::HostMemory host_memory(const farm::Plan& plan, const Setting& setting, int nodes) {
  return farm::share_host_memory(setting.host_budget, setting.film.settings(), setting.pixels(),
                                 static_cast<std::uint32_t>(nodes), static_cast<std::uint32_t>(plan.groups.size()),
                                 setting.sink_threads);
}

Rehearsal::Rehearsal(const FilmCounts& counts, const farm::Plan& plan, const Setting& setting, int nodes,
                     KeyframeLoads& loads)
    : counts_(counts),
      plan_(plan),
      loads_(loads),
      costs_(setting, nodes),
      computers_(setting.platform.machine, nodes),
      routes_(setting.platform.machine.network, computers_.count(), computers_.of(nodes)),
      storage_(setting.platform.machine.storage, setting.platform.machine.network),
      nodes_write_(setting.nodes_write()),
      paces_(setting.even.paces),
      exchanges_(clockwork_, computers_, routes_, costs_.costs(), nodes),
      task_keyframes_(counts.tasks.size()),
      writers_(counts.tasks.size(), kNone),
      exchange_(setting.exchange),
      group_exchanges_(plan.groups.size()),
      nodes_(static_cast<std::size_t>(nodes)),
      result_{0, {},
              0, 0,
              0, costs_.shadow_bytes(),
              0, host_memory(plan, setting, nodes),
              0, std::vector<walls::Busy>(nodes_.size())},
      host_(clockwork_, computers_, storage_, counts, plan, setting, result_.host_memory, nodes,
            {[this](std::size_t group, std::size_t task) { receive_task(group, task); },
             [this](int node) { later(node, way_from_host(node, sizeof(wire::Credit)), &Rehearsal::receive_credit); },
             [this](const StripSent& strip) { return answer(strip); }}) {
  for (std::size_t g = 0; g < plan.groups.size(); ++g) {
    teams_.push_back(wire::team_count(plan.groups[g], plan.teams_of(plan.groups[g])));
    for (int member = 0; member < plan.groups[g].count; ++member) {
      Node& node = nodes_[static_cast<std::size_t>(plan.groups[g].first + member)];
      node.group = g;
      node.member = member;
      node.slots = result_.host_memory.credits;
    }
    for (std::int32_t number = 0; number < teams_.back(); ++number) {
      const collectives::Group team = wire::team_of(plan.groups[g], teams_.back(), number);
      for (int n = team.first; n < team.first + team.count; ++n) {
        nodes_[static_cast<std::size_t>(n)].team = static_cast<std::uint64_t>(number);
        nodes_[static_cast<std::size_t>(n)].of_team = team;
      }
    }
  }
  for (const farm::Task& task : plan.tasks) team_frames_.emplace_back(task.frames.size());
  for (const TaskCounts& task : counts.tasks) host_.add_costs(costs_.host_costs(task, counts.keyframes[task.keyframe]));
  for (const TaskCounts& task : counts.tasks)
    if (!task.inbetweens.empty())
      result_.still_memory = std::max(result_.still_memory,
                                      costs_.still_bytes(counts.keyframes[task.keyframe], plan.groups.front().count));
}

const std::vector<std::vector<NodePart>>& Rehearsal::inbetweens_of(int sharers) {
  const auto [found, fresh] = inbetweens_.try_emplace(sharers);
  if (!fresh) return found->second;
  std::vector<FrameTotals> again;
  for (const wire::FrameCounts& keyframe : counts_.keyframes)
    again.push_back(costs_.drawn_again(keyframe, plan_.groups.front().count));
  for (const TaskCounts& task : counts_.tasks) {
    std::vector<NodePart>& parts = found->second.emplace_back();
    for (const FrameTotals& totals : task.inbetweens)
      parts.push_back(costs_.inbetween(totals, again[task.keyframe], sharers));
  }
  return found->second;
}

Rehearsed Rehearsal::run(double limit) {
  host_.begin();
  const bool ended = clockwork_.run(limit);
  result_.seconds = ended ? host_.ended() : std::numeric_limits<double>::infinity();
  result_.bytes_to_nodes += exchanges_.bytes();
  result_.frames = std::move(host_.frames());
  result_.host_busy = host_.busy_seconds();
  if (nodes_write_) result_.host_memory = farm::where_nodes_write(result_.host_memory);
  return std::move(result_);
}

// Of a task's keyframe, a node of the group that takes it: they take turns.
int Rehearsal::writer_of(std::size_t task, const KeyframeGroup& group) {
  int& writer = writers_[task];
  if (writer == kNone) writer = static_cast<int>(keyframes_so_far_[group.nodes.first]++) % group.contributors;
  return writer;
}

// The same for all nodes of the group that takes the task.
std::shared_ptr<const TaskKeyframe> Rehearsal::keyframe_of(std::size_t number, const collectives::Group& group) {
  if (auto known = task_keyframes_[number].lock()) return known;
  const farm::Task& task = plan_.tasks[number];
  const auto count = static_cast<std::size_t>(group.count);
  KeyframeGroup members{group, plan_.contributors_of(group), std::vector<std::uint8_t>(count), 0};
  members.writer = writer_of(number, members);
  const std::int32_t teams = wire::team_count(group, plan_.teams_of(group));
  for (std::size_t k = 0; k < std::min(static_cast<std::size_t>(teams), task.frames.size() - 1); ++k) {
    const auto number = static_cast<std::int32_t>((task.first_inbetween + k) % static_cast<std::uint64_t>(teams));
    const collectives::Group team = wire::team_of(group, teams, number);
    std::fill_n(members.draws.begin() + (team.first - group.first), team.count, std::uint8_t{1});
  }
  const std::size_t counted = counts_.tasks[number].keyframe;
  auto keyframe = std::make_shared<TaskKeyframe>(shared_keyframe(counted, members));
  keyframe->gifts = costs_.gifts(*keyframe->drawn->load, members);
  task_keyframes_[number] = keyframe;
  return keyframe;
}

std::shared_ptr<const GroupKeyframe> Rehearsal::shared_keyframe(std::size_t number, const KeyframeGroup& group) {
  const auto place = static_cast<std::size_t>(group.nodes.first % computers_.nodes_on_each());
  const KeyframeLoads::Key key{number, static_cast<std::size_t>(group.count()), place, group.has_inbetweens() ? 1u : 0u,
                               static_cast<std::size_t>(group.contributors)};
  const KeyframeCounts& counts = counts_.keyframes[number];
  const auto make = [&] {
    auto load = loads_.of(key, [&] { return costs_.load(counts, counts_.surfaces, group); });
    return std::make_shared<const GroupKeyframe>(costs_.keyframe(std::move(load), counts, group));
  };
  if (counts_.is_exact) return make();
  auto& known = keyframes_[key];
  if (known == nullptr) known = make();
  return known;
}

const NodePart& Rehearsal::part_of(const Node& node) {
  if (node.frame > 0) return inbetweens_of(node.of_team.count)[node.task][node.frame - 1];
  return node.keyframe->drawn->nodes[static_cast<std::size_t>(node.member)];
}

// Of the strip that is next.
double Rehearsal::next_part(const Node& node) {
  const std::vector<double>& parts = part_of(node).strips.parts;
  return parts[parts.size() - node.strips_left];
}

// Of a frame that the node begins: its first, or one that takes more memory than any before.
double Rehearsal::fresh_seconds(Node& node) {
  const double memory = part_of(node).made_memory;
  const double first = node.memory == 0 ? costs_.costs().of(wire::Work::first_frame, 1) : 0;
  const double before = std::exchange(node.memory, std::max(node.memory, memory));
  return first + costs_.costs().of(wire::Work::fresh_byte, node.memory - before);
}

void Rehearsal::receive_task(std::size_t group, std::size_t task) {
  const collectives::Group& nodes = plan_.groups[group];
  const auto bytes = static_cast<double>(farm::render_command(plan_.tasks[task], nodes, {1}).size());
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
  node.keyframe = keyframe_of(node.task, plan_.groups[node.group]);
  work(n, drawing(n, part_of(node).dice + fresh_seconds(node)), &Rehearsal::sum);
}

void Rehearsal::exchange(int n, const Exchange& exchange, void (Rehearsal::*then)(int)) {
  if (exchange.empty()) return (this->*then)(n);
  const Node& node = nodes_[static_cast<std::size_t>(n)];
  exchanges_.begin(n, plan_.groups[node.group].first, exchange[static_cast<std::size_t>(node.member)],
                   [this, n, then] { (this->*then)(n); });
}

void Rehearsal::sum(int n) { exchange(n, nodes_[static_cast<std::size_t>(n)].keyframe->drawn->sum, &Rehearsal::map); }

void Rehearsal::map(int n) {
  work(n, part_of(nodes_[static_cast<std::size_t>(n)]).map, &Rehearsal::exchange_triangles);
}

bool Rehearsal::makes_again(const GroupKeyframe& keyframe, const GroupExchange& so_far) const {
  if (exchange_ != wire::Exchange::automatic) return exchange_ == wire::Exchange::again;
  double guess = 0;
  for (const NodePart& node : keyframe.nodes) guess += node.dice;
  const double making = so_far.made > 1 ? so_far.making : guess;
  return so_far.sent > 1 && 2 * making < so_far.sending;
}

void Rehearsal::exchange_triangles(int n) {
  Node& node = nodes_[static_cast<std::size_t>(n)];
  const GroupKeyframe& keyframe = *node.keyframe->drawn;
  if (keyframe.triangles.empty()) return begin_strips(n);
  GroupExchange& group = group_exchanges_[node.group];
  if (group.begun++ == 0) group.again = makes_again(keyframe, group);
  node.exchange_began = clockwork_.now();
  if (!group.again) return exchange(n, keyframe.triangles, &Rehearsal::end_exchange);
  work(n, drawing(n, keyframe.again[static_cast<std::size_t>(node.member)]), &Rehearsal::end_exchange);
}

void Rehearsal::end_exchange(int n) {
  const Node& node = nodes_[static_cast<std::size_t>(n)];
  GroupExchange& group = group_exchanges_[node.group];
  group.seconds += clockwork_.now() - node.exchange_began;
  if (++group.come == plan_.groups[node.group].count) {
    (group.again ? group.making : group.sending) = group.seconds;
    ++(group.again ? group.made : group.sent);
    group.begun = group.come = 0;
    group.seconds = 0;
  }
  begin_strips(n);
}

void Rehearsal::begin_strips(int n) {
  Node& node = nodes_[static_cast<std::size_t>(n)];
  const NodePart& part = part_of(node);
  node.strips_left = part.strips.count();
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
  work(n, drawing(n, strips.seconds * next_part(node)), &Rehearsal::finish_strip);
}

// The last strip of a keyframe goes once the group's nodes have given each other what inbetweens need.
void Rehearsal::finish_strip(int n) {
  const Node& node = nodes_[static_cast<std::size_t>(n)];
  if (node.strips_left > 1 || node.frame > 0) return send_strip(n);
  exchange(n, node.keyframe->gifts.still, &Rehearsal::send_strip);
}

void Rehearsal::send_strip(int n) {
  Node& node = nodes_[static_cast<std::size_t>(n)];
  if (nodes_write_) return exchange_bands(n);
  if (node.strips_left == 0) return end_frame(n);  // it does not contribute
  const StripCosts& strips = part_of(node).strips;
  const bool same_computer = computers_.of(n) == computers_.of(static_cast<int>(nodes_.size()));
  const double part = next_part(node);
  const double bytes = same_computer ? kOnTheSameComputer : strips.bytes * part;
  const StripSent strip{n, node.task, node.frame, bytes, strips.pasting * part, --node.strips_left == 0};
  const double sent = computers_.work(n, clockwork_.now(), costs_.costs().to_send_host(bytes));
  clockwork_.at(sent, [this, strip] { send_to_host(strip); });
  later(n, sent, strip.last ? &Rehearsal::end_frame : &Rehearsal::draw_strip);
}

void Rehearsal::end_frame(int n) {
  Node& node = nodes_[static_cast<std::size_t>(n)];
  const farm::Task& task = plan_.tasks[node.task];
  const auto teams = static_cast<std::uint64_t>(teams_[node.group]);
  // The next inbetween k whose number in the film has this node's turn.
  std::size_t k = node.frame;
  while (k < task.frames.size() - 1 && (task.first_inbetween + k) % teams != node.team) ++k;
  if (k == task.frames.size() - 1) return begin_task(n);
  node.frame = k + 1;
  const NodePart& part = part_of(node);
  work(n, drawing(n, part.dice + part.map + fresh_seconds(node)), &Rehearsal::begin_strips);
}

// Nodes answer announcements at once.
double Rehearsal::way_from_host(int n, double bytes) {
  const int host = computers_.of(static_cast<int>(nodes_.size())), computer = computers_.of(n);
  const auto length = static_cast<std::size_t>(bytes);
  const double now = clockwork_.now();
  if (!costs_.costs().takes_time(wire::kStrip)) return now;
  if (!routes_.announces(host, computer, length)) return routes_.arrival(host, computer, length, now, now);
  return routes_.rest_arrival(host, computer, length, routes_.arrival(host, computer, 0, now, now), now);
}

// Of the host, which takes it now: when all of it is there.
double Rehearsal::answer(const StripSent& strip) {
  const int host = computers_.of(static_cast<int>(nodes_.size())), computer = computers_.of(strip.node);
  const auto length = static_cast<std::size_t>(strip.bytes);
  const double now = clockwork_.now();
  const bool announced = costs_.costs().takes_time(wire::kStrip) && routes_.announces(computer, host, length);
  return announced ? routes_.rest_arrival(computer, host, length, now, now) : now;
}

// On its way from now on.
void Rehearsal::send_to_host(StripSent message) {
  const int host = computers_.of(static_cast<int>(nodes_.size())), computer = computers_.of(message.node);
  const auto length = static_cast<std::size_t>(message.bytes);
  const double now = clockwork_.now();
  const bool takes_time = costs_.costs().takes_time(wire::kStrip);
  const bool announced = takes_time && routes_.announces(computer, host, length);
  const double arrival = takes_time ? routes_.arrival(computer, host, announced ? 0 : length, now, now) : now;
  clockwork_.at(arrival, [this, message] { host_.arrive(message); });
}

// A keyframe's, after what inbetweens need else.
void Rehearsal::exchange_bands(int n) {
  const Node& node = nodes_[static_cast<std::size_t>(n)];
  if (node.frame > 0 && node.of_team.count > 1) return exchange_team_bands(n);
  if (node.frame > 0) return write_file(n);
  exchange(n, node.keyframe->gifts.bands, &Rehearsal::write_file);
}

// Of an inbetween.
int Rehearsal::writer_of(const Node& node) const {
  return wire::writer_of_inbetween(plan_.tasks[node.task].first_inbetween + node.frame - 1, plan_.groups[node.group],
                                   teams_[node.group], node.of_team);
}

void Rehearsal::exchange_team_bands(int n) {
  Node& node = nodes_[static_cast<std::size_t>(n)];
  const int writer = writer_of(node);
  TeamFrame& frame = team_frames_[node.task][node.frame];
  if (writer == n) {
    if (frame.come == node.of_team.count - 1) return collect_team_bands(n);
    frame.writer_waits = true;
    return;
  }
  const double bytes = part_of(node).team_bytes, now = clockwork_.now();
  result_.bytes_to_nodes += bytes;
  const bool takes_time = costs_.costs().takes_time(wire::kBands);
  const auto length = static_cast<std::size_t>(bytes);
  const double arrival = takes_time ? routes_.arrival(computers_.of(n), computers_.of(writer), length, now, now) : now;
  clockwork_.at(arrival,
                [this, writer, task = node.task, number = node.frame] { receive_team_bands(writer, task, number); });
  work(n, takes_time ? costs_.costs().to_send(bytes) : 0, &Rehearsal::send_drawn);
}

void Rehearsal::receive_team_bands(int writer, std::size_t task, std::size_t number) {
  TeamFrame& frame = team_frames_[task][number];
  ++frame.come;
  if (frame.writer_waits && frame.come == nodes_[static_cast<std::size_t>(writer)].of_team.count - 1)
    collect_team_bands(writer);
}

void Rehearsal::collect_team_bands(int n) {
  const Node& node = nodes_[static_cast<std::size_t>(n)];
  const double each = costs_.costs().takes_time(wire::kBands) ? costs_.costs().to_receive(part_of(node).team_bytes) : 0;
  work(n, (node.of_team.count - 1) * each, &Rehearsal::write_file);
}

// Of a node that has drawn its part of an inbetween, which another writes.
void Rehearsal::send_drawn(int n) {
  const Node& node = nodes_[static_cast<std::size_t>(n)];
  const auto drawn = static_cast<double>(sizeof(wire::Strip));
  send_to_host({n, node.task, node.frame, drawn, 0, true});
  work(n, costs_.costs().to_send(drawn), &Rehearsal::end_frame);
}

bool Rehearsal::writes(const Node& node) const { return node.frame > 0 || node.member == writers_[node.task]; }

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
  node.file_there = storage_.write(computers_.of(n), made, costs_.file_bytes(), clockwork_.now());
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

Rehearsed rehearse(const FilmCounts& counts, const farm::Plan& plan, const Setting& setting, int nodes,
                   KeyframeLoads& loads, double limit) {
  return Rehearsal(counts, plan, setting, nodes, loads).run(limit);
}

Rehearsed rehearse(const FilmCounts& counts, const farm::Plan& plan, const Setting& setting, int nodes, double limit) {
  KeyframeLoads loads;
  return rehearse(counts, plan, setting, nodes, loads, limit);
}

}  // namespace mars::forecast
