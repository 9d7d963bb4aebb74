#include "host/shell/doctor/answers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "host/content/document/text.h"
#include "host/shell/launch/mpi_words.h"
#include "host/shell/launch/text_reader.h"

namespace mars::doctor {
namespace {

using State = Finding::State;

constexpr double kMostAhead = 2;          // seconds, that clocks may differ
constexpr std::size_t kShownWords = 300;  // bytes of what is not understood

double seconds(SystemTime time) { return std::chrono::duration<double>(time.time_since_epoch()).count(); }

// Ssh, srun, shells and loaders say this of machines on which MARS cannot be started. Nearest to the cause first.
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

std::string last_of(const std::string& words) {
  const std::string line = launch::on_one_line(words);
  const std::size_t skipped = line.size() - std::min(line.size(), kShownWords);
  return skipped == 0 ? line : "..." + line.substr(skipped);
}

Finding silence_by_words(const std::string& words, const std::string& self) {
  const auto trouble = [](const std::string& found, const std::string& remedy) {
    return Finding{State::trouble, "machines", found, remedy};
  };
  launch::TextReader libraries(words);
  if (libraries.find("error while loading shared libraries: ")) {
    const std::string library = libraries.word().value_or("");
    return trouble("lacks the library " + library.substr(0, library.find(':')),
                   "install it there, or load it in the job (module load ...)");
  }
  for (const Silence& each : kSilences)
    if (words.find(each.words) != std::string::npos) return trouble(each.found, each.remedy);
  for (const char* lost : {"No such file or directory", "not found", "ermission denied", "xec format error"})
    if (words.find(lost) != std::string::npos && words.find(self) != std::string::npos)
      return trouble("cannot run " + self,
                     "install MARS under the same path on every machine, as on a shared file system");
  return trouble(words.empty() ? "has not answered" : "did not answer; the last words: " + words,
                 "mars doctor there says more");
}

Finding check_doors(const Answers& answers) {
  const std::vector<std::string> failures = who_cannot_reach(answers.missed);
  if (!failures.empty()) return {State::trouble, "ports", document::joined(failures, "\n"), launch::kOpenPorts};
  return {State::good, "ports", "all machines reach each other by TCP", ""};
}

Finding check_clocks(const Answers& answers) {
  std::vector<std::string> wrong;
  for (const auto& [host, ahead] : answers.ahead)
    if (std::abs(ahead) > kMostAhead) wrong.push_back(host + "'s by " + document::formatted("%+.1f s", ahead));
  if (wrong.empty()) return {State::good, "clocks", "differ by less than 2 seconds", ""};
  return {State::note, "clocks", "differ from this machine's: " + document::joined(wrong),
          "keep time by NTP on every machine (Debian: chrony)"};
}

}  // namespace

std::string door_line(const Peer& peer) { return "@door " + doors_line({&peer, 1}); }
std::string clock_line(const std::string& host, SystemTime now) {
  return "@clock " + host + " " + std::to_string(seconds(now)) + "\n";
}
std::string missed_line(const Missed& missed) {
  return "@missed " + missed.from + " " + missed.to + " " + missed.how + "\n";
}
std::string met_line(const std::string& host) { return "@met " + host + "\n"; }

std::string doors_line(std::span<const Peer> peers) {
  std::string line;
  for (const Peer& each : peers)
    line += each.host + " " + std::to_string(each.port) + " " + document::joined(each.addresses, ",") + " ";
  return line + "\n";
}

std::vector<Peer> read_doors(const std::string& line) {
  std::vector<Peer> peers;
  std::istringstream words(line);
  Peer peer;
  for (std::string addresses; words >> peer.host >> peer.port >> addresses; peers.push_back(peer)) {
    peer.addresses.clear();
    std::istringstream list(addresses);
    for (std::string address; std::getline(list, address, ',');) peer.addresses.push_back(address);
  }
  return peers;
}

bool Answers::take(const std::string& line, SystemTime now) {
  std::istringstream words(line);
  std::string kind, host;
  words >> kind;
  if (!kind.starts_with('@')) return add_line(line, findings);
  if (kind == "@door") {
    for (const Peer& each : read_doors(line.substr(kind.size())))
      if (!has_door(each.host)) doors.push_back(each);
    return true;
  }
  words >> host;
  if (!has_door(host)) return false;
  if (kind == "@met") met.insert(host);
  double clock = 0;  // read at any time between the question and the answer
  if (kind == "@clock" && words >> clock)
    ahead[host] = clock > seconds(now) ? clock - seconds(now) : std::min(clock - seconds(given), 0.0);
  Missed miss{host, "", ""};
  if (kind == "@missed" && words >> miss.to && std::getline(words >> std::ws, miss.how)) missed.push_back(miss);
  return true;
}

bool Answers::has_door(const std::string& host) const { return std::ranges::count(doors, host, &Peer::host) > 0; }

// First by who is not reached, then by who does not reach them: a machine behind a firewall is one line.
std::vector<std::string> who_cannot_reach(std::span<const Missed> missed) {
  std::map<std::pair<std::string, std::string>, std::vector<std::string>> from;  // by the other machine and how
  for (const Missed& each : missed) from[{each.to, each.how}].push_back(each.from);
  std::map<std::pair<std::string, std::string>, std::vector<std::string>> to;  // by all machines that miss it and how
  for (const auto& [other, hosts] : from) to[{host_list(hosts), other.second}].push_back(other.first);
  std::vector<std::string> lines;
  for (const auto& [hosts, others] : to)
    lines.push_back(hosts.first + " cannot reach " + host_list(others) + " by TCP: " + hosts.second);
  return lines;
}

std::vector<Finding> check_together(const Answers& answers) {
  std::vector<std::string> names;
  for (const Peer& each : answers.doors) names.push_back(each.host);
  const std::string found = document::counted(names.size(), "machine") + " answered: " + host_list(names);
  if (names.empty()) return {};
  return {{State::good, "machines", found, ""}, check_doors(answers), check_clocks(answers)};
}

Finding check_silence(const std::vector<std::string>& hosts, const std::string& words, const std::string& self) {
  Finding finding = silence_by_words(last_of(words), self);
  finding.found = host_list(hosts) + ": " + finding.found;
  return finding;
}

Finding check_half_answer(const std::vector<std::string>& hosts, const std::string& words) {
  const std::string last = last_of(words);
  return {State::trouble, "machines",
          host_list(hosts) + ": answered, but did not say which others can be reached from there" +
              (last.empty() ? "" : "; the last words: " + last),
          "mars doctor there says more"};
}

}  // namespace mars::doctor
