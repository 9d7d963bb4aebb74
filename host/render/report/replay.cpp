#include "host/render/report/replay.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <unordered_map>
#include <utility>

namespace mars::report {

using walls::Wall;
using walls::Walls;

// A run that is played through.
struct Replay::Run {
  Run(Walls removed, std::size_t count) : without(removed), nodes(count), busy(count) {}

  const Walls without;
  std::vector<double> nodes;      // until when each was busy
  std::vector<walls::Busy> busy;  // what each did
  std::vector<double> drawn;      // when each frame was, in the order of frames_

  double kept(Wall wall, double seconds) const { return without.has(wall) ? 0 : seconds; }
};

// The first of a frame's strips comes after those of frames that its nodes drew before: all nodes of a group meet in
// the sum of a keyframe.
Replay::Replay(const farm::FarmReport& report) : report_(report) {
  std::unordered_map<std::uint32_t, std::size_t> places;
  for (const wire::Strip& strip : report.strips) {
    if (strip.last == 0) continue;
    const auto [place, fresh] = places.try_emplace(strip.frame, frames_.size());
    if (fresh) frames_.push_back({strip.interval, strip.kind == wire::FrameKind::keyframe, {}, 0, 0});
    Frame& frame = frames_[place->second];
    frame.parts.push_back(part_of(strip));
    frame.host += static_cast<double>(strip.work.bytes_to_host);
    frame.strips += strip.number + 1;
  }
  find_waiting();
  separate_messages();
  share_out_host();
  const double files = static_cast<double>(report.files.files);
  if (files > 0) making_ = report.files.making_seconds / files;
  const double all_files = files + static_cast<double>(report.node_files);
  if (all_files > 0) storing_ = report.storing_seconds / all_files;
}

Replay::Part Replay::part_of(const wire::Strip& strip) {
  const wire::PhaseTimes& times = strip.times;
  Part part{static_cast<std::size_t>(strip.node)};
  part.before = times.dice + times.fill;
  part.sum = times.sum;
  part.exchange = times.exchange;
  part.drawing = times.map + times.scanline + times.shadow;
  part.compose = times.compose;
  part.still = times.depth;
  part.bands = times.bands;
  return part;
}

// Nodes that draw inbetweens of an interval wait in its keyframe for what these need. Of a team that shares an
// inbetween, the node that writes it waits for the others: so it is longest with bands.
void Replay::find_waiting() {
  std::set<std::pair<std::uint32_t, std::size_t>> drawn;  // by interval and node
  std::unordered_map<std::size_t, std::size_t> turns;     // keyframes so far, by a group's first node
  for (const Frame& frame : frames_)
    if (!frame.is_keyframe)
      for (const Part& part : frame.parts) drawn.emplace(frame.interval, part.node);
  for (Frame& frame : frames_) {
    std::ranges::sort(frame.parts, {}, &Part::node);
    if (!frame.is_keyframe) {
      std::ranges::max_element(frame.parts, {}, &Part::bands)->writes = true;
      continue;
    }
    for (Part& part : frame.parts) part.waits = drawn.contains({frame.interval, part.node});
    frame.parts[turns[frame.parts.front().node]++ % frame.parts.size()].writes = true;
  }
}

void Replay::share_out_host() {
  double all = 0;
  for (const Frame& frame : frames_) all += frame.host;
  for (Frame& frame : frames_) frame.host *= all > 0 ? report_.busy_seconds / all : 0;
}

Walls Replay::there() const {
  Walls there{Wall::compute, Wall::host};
  const bool several = std::ranges::any_of(report_.groups, [](const auto& group) { return group.count > 1; });
  if (several) there = there.with({Wall::imbalance, Wall::sum, Wall::exchange, Wall::still});
  if (report_.nodes.size() > 1) there.add(Wall::frame);
  if (several && report_.node_files > 0) there.add(Wall::bands);
  if (report_.node_files > 0 || making_ > 0) there.add(Wall::encoder);
  if (storing_ > 0) there.add(Wall::storage);
  return there;
}

// `meet`: how long nodes wait for each other in a step.
template <typename Meet>
void Replay::draw(Run& run, const Frame& frame, const std::vector<walls::Pace>& paces, const Meet& meet) {
  const auto mean = [&](double Part::*step) {
    double all = 0;
    for (const Part& part : frame.parts) all += part.*step;
    return all / static_cast<double>(frame.parts.size());
  };
  const bool even = run.without.has(Wall::imbalance);
  const auto busy = frame.is_keyframe ? &walls::Busy::keyframes : &walls::Busy::inbetweens;
  const auto pace = frame.is_keyframe ? &walls::Pace::keyframes : &walls::Pace::inbetweens;
  const auto work = [&](const Part& part, double Part::*step, Wall wall) {
    const double seconds = run.kept(wall, even ? mean(step) : part.*step);
    run.busy[part.node].*busy += seconds;
    run.nodes[part.node] += seconds * (paces.empty() ? 1 : paces[part.node].*pace);
  };
  for (const Part& part : frame.parts) work(part, &Part::before, Wall::compute);
  meet(&Part::sum, Wall::sum);
  for (const Part& part : frame.parts) {
    run.nodes[part.node] += run.kept(Wall::exchange, part.exchange);
    work(part, &Part::drawing, Wall::compute);
  }
  meet(&Part::still, Wall::still);
  for (const Part& part : frame.parts) work(part, &Part::compose, Wall::encoder);
  meet(&Part::bands, Wall::bands);
  double drawn = 0;
  for (const Part& part : frame.parts) drawn = std::max(drawn, run.nodes[part.node]);
  run.drawn.push_back(drawn);
}

double Replay::last_of(const Run& run, const Frame& frame) {
  double last = 0;
  for (const Part& part : frame.parts) last = std::max(last, run.nodes[part.node]);
  return last;
}

// All nodes of a group wait in the sum of a keyframe.
bool Replay::waits(const Frame& frame, const Part& part, double Part::*step) {
  if (frame.parts.size() == 1) return false;
  return (step == &Part::sum && frame.is_keyframe) || part.waits || (step == &Part::bands && part.writes);
}

// What a node spent in a step after the last had come to it.
void Replay::separate_messages() {
  Run run(Walls(), report_.nodes.size());
  for (Frame& frame : frames_) {
    const auto meet = [&](double Part::*step, Wall) {
      const double last = last_of(run, frame);
      for (Part& part : frame.parts) {
        double& node = run.nodes[part.node];
        const double begun = std::exchange(node, node + part.*step);
        if (waits(frame, part, step)) part.*step = std::max(0.0, node - std::max(begun, last));
      }
    };
    draw(run, frame, {}, meet);
  }
}

double Replay::finish(Run& run) const {
  std::vector<std::size_t> order(frames_.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, {}, [&](std::size_t frame) { return run.drawn[frame]; });
  std::vector<double> sinks(std::max(1u, report_.sinks));
  const bool nodes_write = report_.node_files > 0;
  double host = 0, storage = 0, end = 0;
  for (const std::size_t i : order) {
    const double drawn = run.drawn[i], seconds = run.kept(Wall::host, frames_[i].host);
    // It pastes strips while others are drawn.
    host = std::max(host + seconds, drawn + seconds / std::max(1.0, frames_[i].strips));
    double there = nodes_write ? drawn : host;
    if (!nodes_write && making_ > 0) {
      double& sink = *std::ranges::min_element(sinks);
      there = sink = std::max(sink, there) + run.kept(Wall::encoder, making_);
    }
    if (storing_ > 0) there = storage = std::max(storage, there) + run.kept(Wall::storage, storing_);
    end = std::max({end, there, host});
  }
  return end;
}

double Replay::played(Walls without, const std::vector<walls::Pace>& paces, std::vector<walls::Busy>* busy) const {
  Run run(without, report_.nodes.size());
  for (const Frame& frame : frames_) {
    const auto meet = [&](double Part::*step, Wall wall) {
      const double last = last_of(run, frame);
      for (const Part& part : frame.parts) {
        double& node = run.nodes[part.node];
        node = (waits(frame, part, step) ? last : node) + run.kept(wall, part.*step);
      }
    };
    draw(run, frame, paces, meet);
  }
  const double end = finish(run);
  if (busy != nullptr) *busy = std::move(run.busy);
  return end;
}

double Replay::seconds(Walls without) const {
  std::vector<walls::Busy> busy;
  const double seconds = played(without, {}, &busy);
  return without.has(Wall::frame) ? played(without, walls::even_out(busy, report_.groups), nullptr) : seconds;
}

walls::Explanation explain(const farm::FarmReport& report) {
  const Replay replay(report);
  const double whole = replay.seconds({});
  if (whole <= 0) return {};
  const double beyond = std::max(0.0, report.total_seconds - whole), scale = report.total_seconds / (whole + beyond);
  const auto seconds = [&](Walls without) {
    return (replay.seconds(without) + (without.has(Wall::host) ? 0 : beyond)) * scale;
  };
  return walls::explain(seconds, replay.there());
}

}  // namespace mars::report
