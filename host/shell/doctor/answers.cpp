#include "host/shell/doctor/answers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "host/content/document/text.h"
#include "host/shell/launch/mpi_words.h"
#include "host/shell/launch/text_reader.h"

namespace mars::doctor {
namespace {

using nlohmann::json;
using State = Finding::State;

constexpr double kMostAhead = 2;  // seconds, that clocks may differ
constexpr std::size_t kMostPeers = 1 << 16;
constexpr std::size_t kShownWords = 300;  // bytes of what is not understood

std::string json_line(const json& line) { return line.dump(-1, ' ', false, json::error_handler_t::replace) + "\n"; }

json json_of(const Peer& peer) { return {{"host", peer.host}, {"addresses", peer.addresses}, {"port", peer.port}}; }

Peer peer_of(const json& from) { return {from.at("host"), from.at("addresses"), from.at("port")}; }

// What ssh, srun, shells and loaders say of machines that MARS could not be started on. Nearest to the cause first.
struct Silence {
  const char* words;
  const char* found;
  const char* remedy;
};
constexpr std::array kSilences = {
    Silence{"ould not resolve hostname", "the name does not resolve",
            "write it as ssh knows it, or add it to /etc/hosts"},
    Silence{"Permission denied (", "ssh is refused", "ssh NAME true must work without a password: ssh-copy-id NAME"},
    Silence{"Host key verification failed", "ssh does not know the machine's key", "ssh NAME once by hand"},
    Silence{"timed out", "ssh gets no answer", "check that the machine runs, and that port 22 is open"},
    Silence{"No route to host", "there is no way to the machine", "check that it runs, and its network"},
    Silence{"Connection refused", "ssh is refused: no sshd listens", "start sshd there"},
};

Finding silence_by_words(const std::string& words, const std::string& self) {
  launch::TextReader libraries(words);
  if (libraries.find("error while loading shared libraries: ")) {
    const std::string library = libraries.word().value_or("");
    return {State::trouble, "machines", "lacks the library " + library.substr(0, library.find(':')),
            "install it there, or load it in the job (module load ...)"};
  }
  for (const Silence& each : kSilences)
    if (words.find(each.words) != std::string::npos) return {State::trouble, "machines", each.found, each.remedy};
  for (const char* lost : {"No such file or directory", "not found", "ermission denied", "xec format error"})
    if (words.find(lost) != std::string::npos && words.find(self) != std::string::npos)
      return {State::trouble, "machines", "cannot run " + self,
              "install MARS under the same path on every machine, as on a shared file system"};
  return {State::trouble, "machines", words.empty() ? "has not answered" : "did not answer; the last words: " + words,
          "mars doctor there says more"};
}

std::vector<std::string> names_of(std::span<const MachineAnswer> machines) {
  std::vector<std::string> names;
  for (const MachineAnswer& each : machines) names.push_back(each.presence.peer.host);
  return names;
}

Finding check_presence(std::span<const MachineAnswer> machines) {
  std::string found = document::counted(machines.size(), "machine") + " answered: " + host_list(names_of(machines));
  const auto least = std::ranges::min_element(machines, {}, [](const MachineAnswer& each) {
    return each.presence.memory - 1;  // unknown is most
  });
  if (least->presence.memory != 0)
    found += "; least memory: " + bytes_text(least->presence.memory) + " on " + least->presence.peer.host;
  return {State::good, "machines", found, ""};
}

// The machines by what each has, the most frequent first.
std::vector<std::pair<std::string, std::vector<std::string>>> by_builds(std::span<const MachineAnswer> machines) {
  std::map<std::string, std::vector<std::string>> all;
  for (const MachineAnswer& each : machines) all[each.presence.build].push_back(each.presence.peer.host);
  std::vector<std::pair<std::string, std::vector<std::string>>> sorted(all.begin(), all.end());
  std::ranges::stable_sort(sorted, std::greater(), [](const auto& each) { return each.second.size(); });
  return sorted;
}

Finding check_builds(std::span<const MachineAnswer> machines) {
  const auto builds = by_builds(machines);
  if (builds.size() == 1) return {State::good, "versions", "the same MARS on all machines: " + builds[0].first, ""};
  std::vector<std::string> texts;
  for (const auto& [build, hosts] : builds) texts.push_back(host_list(hosts) + ": " + build);
  return {State::trouble, "versions", document::joined(texts, "; "),
          "install the same MARS on every machine: different versions do not understand each other"};
}

// Which machine has which, the machines' own findings say.
bool have_one_mpi(std::span<const MachineFindings> machines) {
  std::set<std::string> all;
  for (const MachineFindings& machine : machines)
    for (const Finding& each : machine.findings)
      if (each.about == "MPI") all.insert(each.found);
  return all.size() <= 1;
}

Finding check_doors(std::span<const MachineAnswer> machines) {
  const std::vector<std::string> failures = who_cannot_reach(machines);
  if (!failures.empty()) return {State::trouble, "ports", document::joined(failures, "\n"), launch::kOpenPorts};
  return {State::good, "ports", "all machines reach each other by TCP", ""};
}

Finding check_clocks(std::span<const MachineAnswer> machines) {
  std::vector<std::string> wrong;
  for (const MachineAnswer& each : machines)
    if (each.ahead && std::abs(*each.ahead) > kMostAhead)
      wrong.push_back(each.presence.peer.host + "'s by " + document::formatted("%+.1f s", *each.ahead));
  if (wrong.empty()) return {State::good, "clocks", "differ by less than 2 seconds", ""};
  return {State::note, "clocks", "differ from this machine's: " + document::joined(wrong),
          "keep time by NTP on every machine (Debian: chrony)"};
}

Finding check_folder(std::span<const MachineAnswer> machines, const std::string& folder) {
  std::vector<std::string> blind;
  for (const MachineAnswer& each : machines)
    if (!each.presence.sees_folder) blind.push_back(each.presence.peer.host);
  if (blind.empty()) return {State::good, "folder", "all machines see " + folder, ""};
  return {State::note, "folder", host_list(blind) + ": cannot see " + folder + " of this machine",
          "render into a folder that all machines share; without one use --write host"};
}

}  // namespace

std::string line_of(const Presence& presence) {
  json line = json_of(presence.peer);
  line.update({{"build", presence.build}, {"memory", presence.memory}, {"sees", presence.sees_folder}});
  return json_line(line);
}

std::string clock_line(const std::string& host, SystemTime now) {
  return json_line({{"host", host}, {"clock", std::chrono::duration<double>(now.time_since_epoch()).count()}});
}

std::string line_of(const std::string& host, std::span<const Missed> missed) {
  json list = json::array();
  for (const Missed& each : missed) list.push_back({each.to, each.how});
  return json_line({{"host", host}, {"missed", list}});
}

std::string line_of(std::span<const Peer> peers) {
  json list = json::array();
  for (const Peer& each : peers) list.push_back(json_of(each));
  return json_line(list);
}

std::optional<std::vector<Peer>> read_peers(const std::string& line) try {
  std::vector<Peer> peers;
  for (const json& each : json::parse(line)) peers.push_back(peer_of(each));
  return peers;
} catch (const json::exception&) {
  return std::nullopt;
}

bool Answers::take(const std::string& line, SystemTime now) try {
  const json from = json::parse(line, nullptr, false);
  if (!from.is_object() || !from.contains("host")) return false;
  const std::string host = from.at("host");
  if (from.contains("about")) return add_line(line, findings_);
  if (from.contains("port") && !is_present(host) && machines_.size() < kMostPeers)
    machines_.push_back({{peer_of(from), from.at("build"), from.at("memory"), from.at("sees")}, {}, {}});
  const auto machine = std::ranges::find(machines_, host, [](const auto& each) { return each.presence.peer.host; });
  if (machine == machines_.end()) return false;
  if (from.contains("clock")) {
    const auto seconds = [](SystemTime time) { return std::chrono::duration<double>(time.time_since_epoch()).count(); };
    const double clock = from.at("clock"), ahead = clock - seconds(now), behind = clock - seconds(sent_);
    machine->ahead = ahead > 0 ? ahead : std::min(behind, 0.0);
  }
  if (from.contains("missed")) {
    machine->missed.emplace();
    for (const json& each : from.at("missed")) machine->missed->push_back({each.at(0), each.at(1)});
  }
  return true;
} catch (const json::exception&) {
  return false;
}

std::vector<Peer> Answers::peers() const {
  std::vector<Peer> peers;
  for (const MachineAnswer& each : machines_) peers.push_back(each.presence.peer);
  return peers;
}

const MachineAnswer* Answers::find(const std::string& host) const {
  const auto machine = std::ranges::find(machines_, host, [](const auto& each) { return each.presence.peer.host; });
  return machine == machines_.end() ? nullptr : &*machine;
}

// First by who is not reached, then by who does not reach them: a machine behind a firewall is one line.
std::vector<std::string> who_cannot_reach(std::span<const MachineAnswer> machines) {
  std::map<std::pair<std::string, std::string>, std::vector<std::string>> from;  // by the other machine and how
  for (const MachineAnswer& each : machines)
    for (const Missed& missed : each.missed.value_or(std::vector<Missed>()))
      from[{missed.to, missed.how}].push_back(each.presence.peer.host);
  std::map<std::pair<std::string, std::string>, std::vector<std::string>> to;  // by all machines that miss it and how
  for (const auto& [other, hosts] : from) to[{host_list(hosts), other.second}].push_back(other.first);
  std::vector<std::string> lines;
  for (const auto& [hosts, others] : to)
    lines.push_back(hosts.first + " cannot reach " + host_list(others) + " by TCP: " + hosts.second);
  return lines;
}

std::vector<Finding> check_together(const Answers& answers, const std::string& folder) {
  const auto machines = answers.machines();
  if (machines.empty()) return {};
  std::vector<Finding> findings{check_presence(machines), check_builds(machines), check_doors(machines),
                                check_clocks(machines)};
  if (!have_one_mpi(answers.findings()))
    findings.push_back({State::note, "versions", "the machines have different MPIs: see MPI below",
                        "install the same MPI under the same path on every machine"});
  if (!folder.empty()) findings.push_back(check_folder(machines, folder));
  return findings;
}

Finding check_silence(const std::vector<std::string>& hosts, const std::string& words, const std::string& self) {
  const std::string line = launch::on_one_line(words);
  const std::size_t skipped = line.size() - std::min(line.size(), kShownWords);
  Finding finding = silence_by_words(skipped == 0 ? line : "..." + line.substr(skipped), self);
  finding.found = host_list(hosts) + ": " + finding.found;
  return finding;
}

}  // namespace mars::doctor
