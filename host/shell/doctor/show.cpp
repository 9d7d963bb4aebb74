#include "host/shell/doctor/show.h"

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <set>

#include "host/cli/wrapped.h"
#include "topology/placement.h"

namespace mars::doctor {
namespace {

using nlohmann::json;
using State = Finding::State;

constexpr std::size_t kStateColumn = 2;
constexpr std::size_t kAboutColumn = 11;
constexpr std::size_t kFoundColumn = 23;

std::string padded(std::string text, std::size_t column) {
  text.resize(std::max(text.size() + 1, column), ' ');
  return text;
}

const char* word_of(State state) { return state == State::good ? "ok" : state == State::note ? "note" : "TROUBLE"; }

std::string text_of(const Finding& finding) {
  std::string line = padded(std::string(kStateColumn, ' ') + word_of(finding.state), kAboutColumn);
  line = padded(line + finding.about, kFoundColumn) + cli::wrapped(finding.found, kFoundColumn) + "\n";
  if (finding.remedy.empty()) return line;
  return line + std::string(kFoundColumn, ' ') + "-> " + cli::wrapped(finding.remedy, kFoundColumn + 3) + "\n";
}

std::size_t count(std::span<const Finding> findings, State state) {
  return static_cast<std::size_t>(
      std::count_if(findings.begin(), findings.end(), [&](const Finding& each) { return each.state == state; }));
}

// "n" and "03" of "n03".
std::pair<std::string, std::string> name_and_number(const std::string& host) {
  std::size_t digits = host.size();
  while (digits > 0 && host.size() - digits < 9 && std::isdigit(static_cast<unsigned char>(host[digits - 1])) != 0)
    --digits;
  return {host.substr(0, digits), host.substr(digits)};
}

bool follows(const std::string& next, const std::string& last) {
  const auto [name, number] = name_and_number(last);
  const auto [next_name, next_number] = name_and_number(next);
  if (name != next_name || number.empty() || next_number.empty()) return false;
  if (number.size() != next_number.size() && (number[0] == '0' || next_number[0] == '0')) return false;
  return std::stol(next_number) == std::stol(number) + 1;
}

bool before(const std::string& a, const std::string& b) {
  const auto [name_a, number_a] = name_and_number(a);
  const auto [name_b, number_b] = name_and_number(b);
  if (name_a != name_b || number_a.empty() || number_b.empty()) return a < b;
  return std::stol(number_a) < std::stol(number_b);
}

struct Group {
  Finding finding;
  std::vector<std::string> hosts;
};

// Of all machines' findings about one thing.
std::vector<Group> groups_about(const std::string& about, std::span<const MachineFindings> machines) {
  std::vector<Group> groups;
  for (const MachineFindings& machine : machines) {
    for (const Finding& finding : machine.findings) {
      if (finding.about != about) continue;
      auto group = std::find_if(groups.begin(), groups.end(), [&](const Group& g) { return g.finding == finding; });
      if (group == groups.end()) group = groups.insert(group, {finding, {}});
      group->hosts.push_back(machine.host);
    }
  }
  return groups;
}

std::string cores_text(const topology::Place& place) {
  if (place.count == 1) return "core " + std::to_string(place.first);
  return "cores " + std::to_string(place.first) + "-" + std::to_string(place.first + place.count - 1);
}

}  // namespace

std::string host_list(std::vector<std::string> hosts) {
  std::sort(hosts.begin(), hosts.end(), before);
  hosts.erase(std::unique(hosts.begin(), hosts.end()), hosts.end());
  std::string text;
  for (std::size_t first = 0; first < hosts.size();) {
    std::size_t last = first;
    while (last + 1 < hosts.size() && follows(hosts[last + 1], hosts[last])) ++last;
    text += (text.empty() ? "" : ",") + hosts[first];
    if (last > first) text += (last > first + 1 ? "-" : ",") + hosts[last];
    first = last + 1;
  }
  return text;
}

std::vector<Finding> grouped(std::span<const MachineFindings> machines) {
  std::vector<std::string> topics;
  for (const MachineFindings& machine : machines) {
    for (const Finding& finding : machine.findings)
      if (std::find(topics.begin(), topics.end(), finding.about) == topics.end()) topics.push_back(finding.about);
  }
  std::vector<Finding> findings;
  for (const std::string& about : topics) {
    for (Group& group : groups_about(about, machines)) {
      if (group.hosts.size() < machines.size())
        group.finding.found = host_list(group.hosts) + ": " + group.finding.found;
      findings.push_back(group.finding);
    }
  }
  return findings;
}

std::string text_of(std::span<const Finding> findings) {
  std::string text;
  for (const Finding& finding : findings) text += text_of(finding);
  return text;
}

std::string verdict(std::span<const Finding> findings) {
  const std::size_t troubles = count(findings, State::trouble);
  if (troubles == 0) return "No trouble found: mars render FILM -o DIR";
  return std::to_string(troubles) + (troubles == 1 ? " trouble" : " troubles") + "; the remedy is below each (->)";
}

bool in_trouble(std::span<const Finding> findings) { return count(findings, State::trouble) > 0; }

std::string short_text(std::span<const Finding> findings) {
  std::string text;
  for (const Finding& finding : findings) {
    if (finding.state != State::trouble) continue;
    text += finding.about + ": " + finding.found + (finding.remedy.empty() ? "" : " (" + finding.remedy + ")") + "\n";
  }
  return text + "for more run mars doctor";
}

std::string lines_of(const MachineFindings& machine) {
  std::string lines;
  for (const Finding& finding : machine.findings) {
    lines += json{{"host", machine.host},
                  {"state", finding.state},
                  {"about", finding.about},
                  {"found", finding.found},
                  {"remedy", finding.remedy}}
                 .dump(-1, ' ', false, json::error_handler_t::replace) +
             "\n";
  }
  return lines;
}

bool add_line(std::string_view line, std::vector<MachineFindings>& machines) try {
  const json from = json::parse(line, nullptr, false);
  if (!from.is_object() || !from.contains("host")) return false;
  const std::string host = from.at("host");
  auto machine =
      std::find_if(machines.begin(), machines.end(), [&](const MachineFindings& m) { return m.host == host; });
  if (machine == machines.end()) machine = machines.insert(machine, {host, {}});
  machine->findings.push_back({from.at("state"), from.at("about"), from.at("found"), from.at("remedy")});
  return true;
} catch (const json::exception&) {
  return false;
}

std::string placement_text(const topology::Machine& machine, int nodes, int reserved) {
  if (!machine.place(0, nodes, reserved))
    return std::to_string(nodes) + " nodes on " + std::to_string(machine.cores()) + " cores: none is bound to any\n";
  std::string text = "Nodes by core, as mars render places them on this machine:\n";
  constexpr int kInALine = 4;
  std::vector<topology::Location> locations;
  for (int node = 0; node < nodes; ++node) {
    const topology::Place place = *machine.place(node, nodes, reserved);
    locations.push_back({0, machine.seat(place)});
    const bool ends = node % kInALine == kInALine - 1 || node == nodes - 1;
    const std::string entry = padded(std::to_string(node) + ":", 4) + cores_text(place);
    text += "  " + (ends ? entry + "\n" : padded(entry, 17));
  }
  const auto shared = topology::dimensions(locations);
  for (std::size_t d = 0; d < shared.size(); ++d) {
    text += "  across dimension " + std::to_string(d) + " neighbours share " +
            std::string(topology::text_of(shared[d])) + "\n";
  }
  return text;
}

}  // namespace mars::doctor
