#include "host/shell/launch/job_watch.h"

#include <cmath>
#include <utility>

namespace mars::launch {
namespace {

std::string whole_seconds(double seconds) { return std::to_string(std::lround(seconds)) + " seconds"; }

std::string whole_seconds(std::chrono::seconds seconds) { return std::to_string(seconds.count()) + " seconds"; }

// "node 3 on n2 has said nothing for 11 seconds; it was drawing frame 12 (scanline)"
std::string line_of(const events::Beat::Node& node) {
  std::string text =
      "node " + std::to_string(node.node) + " on " + node.host + " has said nothing for " + whole_seconds(node.silent);
  if (node.frame >= 0) text += "; it was drawing frame " + std::to_string(node.frame);
  if (!node.doing.empty()) text += (node.frame >= 0 ? " (" : "; last: ") + node.doing + (node.frame >= 0 ? ")" : "");
  return text;
}

}  // namespace

void JobWatch::hear(const events::Event& event) {
  heard_ = time_.passed();
  if (std::exchange(host_named_, false)) lines_.emplace_back("the host is heard again");
  if (const auto* beat = std::get_if<events::Beat>(&event)) hear_nodes(*beat);
  if (std::holds_alternative<events::Loading>(event)) loading_ = true;
  if (std::holds_alternative<events::Loaded>(event)) {
    loading_ = false;
    waiting_since_ = heard_;
  }
  if (std::holds_alternative<events::Booted>(event)) booted_ = true;
  if (std::holds_alternative<events::Done>(event) || std::holds_alternative<events::Fault>(event)) last_word_ = true;
}

void JobWatch::hear_nodes(const events::Beat& beat) {
  beats_ = true;
  host_doing_ = beat.doing;
  std::set<std::int32_t> silent;
  for (const events::Beat::Node& node : beat.silent) {
    const bool named = silent_.contains(node.node);
    if (!named && node.silent < static_cast<double>(kNamed.count())) continue;
    if (!named) lines_.push_back(line_of(node));
    silent.insert(node.node);
  }
  for (const std::int32_t node : silent_)
    if (!silent.contains(node)) lines_.push_back("node " + std::to_string(node) + " is heard again");
  silent_ = std::move(silent);
}

JobWatch::Findings JobWatch::look(Clock::time_point now) {
  time_.look(now);
  Findings found{std::exchange(lines_, {}), ""};
  const Clock::duration silence = since(heard_);
  if (last_word_) {
    if (silence >= kLastWord) found.end = "the job has not ended " + whole_seconds(kLastWord) + " after its last word";
    return found;
  }
  if (!booted_ && !loading_ && since(waiting_since_) >= kNobodyBoots)
    found.end = "not all nodes have answered for " + whole_seconds(kNobodyBoots);
  if (!beats_) return found;
  if (silence >= kNamed && !std::exchange(host_named_, true))
    found.lines.push_back("the host has said nothing for " + whole_seconds(kNamed) + "; it was " + host_doing_);
  if (silence >= kHostHangs)
    found.end = "the host has said nothing for " + whole_seconds(kHostHangs) + "; it was " + host_doing_;
  return found;
}

}  // namespace mars::launch
