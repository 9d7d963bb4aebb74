#include "host/render/session/status_board.h"

#include <time.h>

#include <algorithm>
#include <utility>

namespace mars::session {

namespace {

constexpr std::size_t kWarnings = 3;

template <typename Act>
void for_each_node(sinks::Status& status, const Act& act) {
  for (sinks::Status::Machine& machine : status.machines) std::ranges::for_each(machine.nodes, act);
}

}  // namespace

StatusBoard::StatusBoard(std::string film) {
  status_.process = sinks::this_process();
  status_.since = time(nullptr);
  status_.film = std::move(film);
}

void StatusBoard::note(const events::Event& event) {
  const std::lock_guard lock(mutex_);
  if (const auto* booted = std::get_if<events::Booted>(&event)) note_booted(*booted);
  if (const auto* progress = std::get_if<events::Progress>(&event)) note_progress(*progress);
  if (const auto* beat = std::get_if<events::Beat>(&event)) note_beat(*beat);
  if (const auto* warning = std::get_if<events::Warning>(&event)) note_warning(*warning);
}

void StatusBoard::note_booted(const events::Booted& booted) {
  status_.machines.clear();
  drawn_.assign(booted.nodes.size(), 0);
  for (const events::Booted::Node& node : booted.nodes) {
    auto machine = std::ranges::find(status_.machines, node.host, &sinks::Status::Machine::name);
    if (machine == status_.machines.end()) machine = status_.machines.insert(machine, {node.host, {}});
    machine->nodes.push_back({.node = node.node, .doing = ""});
  }
}

void StatusBoard::note_progress(const events::Progress& progress) {
  status_.done = progress.done();
  status_.of = progress.of();
  status_.seconds = progress.seconds();
  const auto left = progress.left();
  status_.left = left ? std::optional(left->keyframes + left->inbetweens) : std::nullopt;
}

void StatusBoard::note_beat(const events::Beat& beat) {
  status_.doing = beat.doing;
  for_each_node(status_, [&](sinks::Status::Node& node) {
    const auto silent = std::ranges::find(beat.silent, node.node, &events::Beat::Node::node);
    const events::Beat::Node now = silent == beat.silent.end() ? events::Beat::Node() : *silent;
    node.silent = now.silent;
    node.frame = now.frame;
    node.doing = now.doing;
  });
}

void StatusBoard::note_warning(const events::Warning& warning) {
  if (status_.warnings.size() == kWarnings) status_.warnings.erase(status_.warnings.begin());
  status_.warnings.push_back(warning.text);
}

void StatusBoard::note_drawn(const farm::FinishedFrame& frame) {
  const std::lock_guard lock(mutex_);
  for (std::int32_t node = frame.first_node; node < frame.first_node + frame.nodes; ++node)
    ++drawn_[static_cast<std::size_t>(node)];
}

void StatusBoard::note_slow(int slow, double slowness) {
  const std::lock_guard lock(mutex_);
  for_each_node(status_, [&](sinks::Status::Node& node) {
    if (node.node == slow) node.slow = slowness;
  });
}

sinks::Status StatusBoard::status() const {
  const std::lock_guard lock(mutex_);
  sinks::Status now = status_;
  now.written = time(nullptr);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begun_;
  if (!drawn_.empty()) now.used.processor_seconds = seconds.count() * static_cast<double>(drawn_.size() + 1);
  for_each_node(now, [&](sinks::Status::Node& node) { node.frames = drawn_[static_cast<std::size_t>(node.node)]; });
  return now;
}

}  // namespace mars::session
