#include "host/shell/launch/machines.h"

#include <algorithm>
#include <utility>

namespace mars::launch {
namespace {

std::uint32_t slots_of(const std::vector<Slots>& machines) {
  std::uint32_t slots = 0;
  for (const Slots& each : machines) slots += each.count;
  return slots;
}

}  // namespace

Machines::Machines(std::vector<Slots> all, std::uint32_t nodes) : all_(std::move(all)), nodes_(nodes) {
  for (const Slots& each : all_) answered_.insert(each.host);
}

void Machines::blame(const std::string& machine, bool lost, bool new_frames) {
  const bool again = !new_frames && !machine.empty() && machine == blamed_;
  left_out_ = lost || again ? machine : "";
  blamed_ = machine;
  lost_ = lost;
}

std::vector<std::string> Machines::names() const {
  std::vector<std::string> names;
  for (const Slots& each : all_) names.push_back(each.host);
  return names;
}

Machines::Choice Machines::choose(const std::set<std::string>& answering) {
  if (lost_ && another_is_gone(answering)) left_out_ = "";
  answered_ = answering;
  Choice choice = without(answering, std::exchange(left_out_, ""));
  return choice.use.empty() ? without(answering, "") : choice;
}

bool Machines::another_is_gone(const std::set<std::string>& answering) const {
  return std::ranges::any_of(
      answered_, [&](const std::string& machine) { return machine != blamed_ && !answering.contains(machine); });
}

Machines::Choice Machines::without(const std::set<std::string>& answering, const std::string& blamed) const {
  Choice choice;
  for (const Slots& each : all_) {
    if (answering.contains(each.host) && each.host != blamed)
      choice.use.push_back(each);
    else
      choice.left_out.push_back(each.host);
  }
  if (all_.empty()) {
    choice.nodes = nodes_;
  } else if (!choice.use.empty()) {
    const std::uint64_t share = std::uint64_t{nodes_} * slots_of(choice.use) / slots_of(all_);
    choice.nodes = static_cast<std::uint32_t>(std::max<std::uint64_t>(share, 1));
  }
  return choice;
}

}  // namespace mars::launch
