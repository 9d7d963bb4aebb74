#include "host/render/farm/heartbeats.h"

#include <algorithm>
#include <chrono>
#include <future>

#include "hal/messages/process.h"
#include "hal/nx/nx_messages.h"
#include "host/render/farm/node_inbox.h"

namespace mars::farm {
namespace {

// Seconds.
constexpr double kLook = 0.1;    // from one look to the next
constexpr double kSpeak = 5.0;   // from one beat to the nodes to the next
constexpr double kReport = 2.0;  // from one report to the next
constexpr double kNamed = 5.0;   // a node that is silent for so long is reported

constexpr std::chrono::milliseconds kPause{20};  // of the host's thread while another works

std::string doing_of(const wire::Beat& beat, bool debugged) {
  const std::string what = beat.frame < 0 ? "waiting for work"
                           : beat.phase == wire::Phase::storage
                               ? "waiting for storage"
                               : wire::kPhaseNames[static_cast<std::size_t>(beat.phase)];
  return what + (debugged ? ", in a debugger" : "");
}

}  // namespace

Heartbeats::Heartbeats(const std::string& host, std::int32_t process, HeartbeatListener listener)
    : listener_(std::move(listener)),
      has_machine_clock_(messages::process().backend().has_machine_clock()),
      looked_(dclock()),
      spoken_(looked_),
      reported_(looked_) {
  std::copy_n(host.begin(), std::min(host.size(), own_.host.size() - 1), own_.host.begin());
  own_.process = process;
  if (!has_machine_clock_) return;
  messages::process().while_waiting([this] { look(); });
  speak();
}

Heartbeats::~Heartbeats() { messages::process().while_waiting({}); }

// What it throws ends the program; it can be waited for only as long as `work` takes.
void Heartbeats::during(const std::string& doing, const std::function<void()>& work) {
  if (!has_machine_clock_) return work();
  const std::string before = std::exchange(doing_, doing);
  std::future<void> done = std::async(std::launch::async, work);
  while (done.wait_for(kPause) != std::future_status::ready) look();
  done.get();
  doing_ = before;
}

void Heartbeats::look() {
  if (!has_machine_clock_) return;
  const double now = dclock();
  if (now < looked_ + kLook) return;
  looked_ = now;
  if (watch_) watch_->look(now);
  receive();
  if (listener_.asked_to_end()) listener_.end(drawing());
  if (nodes_listen_ && now >= spoken_ + kSpeak) {
    spoken_ = now;
    speak();
  }
  if (now >= reported_ + kReport) {
    reported_ = now;
    report();
  }
  if (watch_) check_nodes();
}

void Heartbeats::speak() {
  own_.traced = listener_.is_traced(own_.process) ? 1 : 0;
  for (long node = 0; node < numnodes(); ++node) csend(wire::kBeat, &own_, sizeof own_, node, 0);
}

void Heartbeats::receive() {
  while (iprobe(wire::kBeat) != 0) receive_beat();
}

// Before all nodes have greeted it may be of another version's.
void Heartbeats::receive_beat() {
  const int node = static_cast<int>(infonode());
  std::vector<std::byte> message(static_cast<std::size_t>(infocount()));
  crecv(wire::kBeat, message.data(), static_cast<long>(message.size()));
  if (!watch_) return;
  const std::optional<wire::Beat> beat = read_beat(message);
  if (!beat) throw NodeFailure("sent a beat that makes no sense", name_of(node), node);
  watch_->hear(node, *beat);
}

void Heartbeats::watch(std::span<const wire::Hello> hellos) {
  hellos_.assign(hellos.begin(), hellos.end());
  if (has_machine_clock_) watch_.emplace(hellos.size());
}

void Heartbeats::hear(const wire::Strip& strip) {
  if (!watch_) return;
  watch_->hear(strip.node);
  if (strip.last == 1) watch_->note(strip.times);
}

void Heartbeats::forget_nodes() {
  watch_.reset();
  nodes_listen_ = false;
}

void Heartbeats::report() {
  std::vector<SilentNode> silent_nodes;
  if (watch_)
    for (const int node : watch_->silent(kNamed)) silent_nodes.push_back(silent(node));
  listener_.beat(doing_, silent_nodes);
}

SilentNode Heartbeats::silent(int node) const {
  return {node, hellos_[static_cast<std::size_t>(node)].host.data(), frame_of(node),
          doing_of(watch_->beat(node), is_debugged(node)), watch_->silence(node)};
}

std::vector<NodeFrame> Heartbeats::drawing() const {
  std::vector<NodeFrame> drawing;
  if (!watch_ || !drawing_) return drawing;
  for (int node = 0; node < static_cast<int>(hellos_.size()); ++node)
    if (const int frame = frame_of(node); frame >= 0) drawing.push_back({node, static_cast<std::uint32_t>(frame)});
  return drawing;
}

int Heartbeats::frame_of(int node) const {
  const std::int32_t begun = watch_->beat(node).frame;
  if (!drawing_) return begun;
  const auto frame = drawing_(node, begun);
  return frame ? static_cast<int>(*frame) : -1;
}

void Heartbeats::check_nodes() const {
  for (const int node : watch_->hanging()) {
    if (is_debugged(node)) continue;
    const SilentNode found = silent(node);
    throw NodeFailure::hangs(name_of(node), found.doing, static_cast<int>(found.seconds), node, found.frame);
  }
}

// One that is stopped by its debugger cannot say so; where it is on the host's machine, it shows.
bool Heartbeats::is_debugged(int node) const {
  const wire::Beat& beat = watch_->beat(node);
  return beat.traced == 1 || (beat.host == own_.host && listener_.is_traced(beat.process));
}

std::string Heartbeats::name_of(int node) const {
  return with_machine(hellos_[static_cast<std::size_t>(node)].host.data(), node);
}

}  // namespace mars::farm
