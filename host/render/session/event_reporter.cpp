#include "host/render/session/event_reporter.h"

#include <iostream>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "hal/failure/explain.h"
#include "hal/failure/failure.h"
#include "hal/failure/plain_text.h"
#include "host/render/farm/node_inbox.h"

namespace mars::session {
namespace {

events::Booted booted_event(std::span<const wire::Hello> hellos, const std::string& backend) {
  events::Booted event;
  event.backend = backend;
  std::set<std::int32_t> machines;
  for (const wire::Hello& hello : hellos) {
    machines.insert(hello.machine);
    event.nodes.push_back({hello.node, hello.host.data(), hello.rank, hello.binding.data(), hello.simd.data()});
  }
  event.machines = static_cast<std::uint32_t>(machines.size());
  return event;
}

// One for each machine whose nodes are kept apart.
std::vector<events::Warning> warnings_of(std::span<const wire::Hello> hellos) {
  std::map<std::string, std::string> reasons;  // by machine
  for (const wire::Hello& hello : hellos)
    if (hello.apart[0] != 0) reasons.emplace(hello.host.data(), hello.apart.data());
  std::vector<events::Warning> warnings;
  for (const auto& [machine, reason] : reasons)
    warnings.push_back({"the nodes on " + machine + " cannot share memory (" + reason +
                        "): each has a film of its own, and they send each other messages"});
  return warnings;
}

}  // namespace

void EventReporter::report(const events::Event& event) const {
  board_.note(event);
  const std::string line = plain_text(events::line_of(event));  // the same JSON
  const std::lock_guard lock(mutex_);
  std::cout << line << std::flush;
}

// Where nobody takes it any more, there is nobody to render for.
void EventReporter::report_beat(const std::string& doing, const std::vector<farm::SilentNode>& silent) const {
  events::Beat beat{doing, {}};
  for (const farm::SilentNode& node : silent)
    beat.silent.push_back({node.node, node.host, node.frame, node.doing, node.seconds});
  report(beat);
  if (!std::cout) throw Failure("nobody reads what the host reports", "standard output", "");
}

void EventReporter::report_drawing(const std::vector<farm::NodeFrame>& drawing) const {
  events::Drawing event;
  for (const auto& [node, frame] : drawing) event.nodes.push_back({node, static_cast<std::int32_t>(frame)});
  report(event);
}

void EventReporter::report_progress(double seconds) {
  progress_.forecast = course_.left(progress_.done(), seconds);
  report(progress_);
}

farm::FarmListener EventReporter::listener(std::size_t intervals) {
  progress_.intervals = static_cast<std::uint32_t>(intervals);
  farm::FarmListener listener;
  listener.booted = [this](std::span<const wire::Hello> hellos, std::uint32_t keyframes, std::uint32_t inbetweens) {
    progress_.keyframes.of = keyframes;
    progress_.inbetweens.of = inbetweens;
    report(booted_event(hellos, backend_));
    for (const events::Warning& warning : warnings_of(hellos)) report(warning);
    report_progress(0);
  };
  listener.slowed = [this](int node, double slowness) { board_.note_slow(node, slowness); };
  listener.warned = [this](const std::string& text) { report(events::Warning{text}); };
  listener.finished = [this](const farm::FinishedFrame& frame) {
    board_.note_drawn(frame);
    report(events::FrameTaken{frame.number, frame.interval, frame.kind});
    progress_.count(frame.kind, frame.interval, frame.seconds);
    report_progress(frame.seconds);
  };
  return listener;
}

events::Fault fault_of(const std::exception& reason) {
  const Failure failure = explain(reason);
  events::Fault fault{failure.problem, failure.where, failure.remedy, {}, {}, ""};
  if (const auto* at_node = dynamic_cast<const farm::NodeFailure*>(&reason)) fault.node = at_node->node;
  return fault;
}

}  // namespace mars::session
