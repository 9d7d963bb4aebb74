#include "host/shell/launch/diagnosis.h"

#include <netdb.h>
#include <signal.h>
#include <sys/socket.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <set>

#include "host/content/document/text.h"
#include "host/shell/launch/mpi_words.h"
#include "host/shell/launch/text_reader.h"

namespace mars::launch {

namespace {

constexpr std::size_t kShownWords = 40;  // lines of what is not understood

// The last `most` lines as one text.
std::string join(const std::deque<std::string>& lines, std::size_t most) {
  std::string text;
  const auto skipped = lines.size() - std::min(most, lines.size());
  for (auto line = lines.begin() + static_cast<std::ptrdiff_t>(skipped); line != lines.end(); ++line)
    text += *line + "\n";
  return text;
}

std::string killed_by(const std::string& process, int signal) {
  return process + " was killed by signal " + std::to_string(signal) + " (" + strsignal(signal) + ")";
}

std::string remedy_for(int signal) {
  if (signal == SIGKILL) {
    return "perhaps the machine ran out of memory, see dmesg: try fewer --nodes, or set MARS_MEMORY to fewer "
           "MiB";
  }
  if (signal == SIGXFSZ) return "files may not grow as large as they must: raise ulimit -f";
  return "please report it with the film";
}

Failure failure_from(const events::Fault& fault) {
  const std::string again = fault.replay.empty() ? "" : "to see it again: " + fault.replay;
  const std::string remedy = fault.remedy.empty() || again.empty() ? fault.remedy + again : fault.remedy + "; " + again;
  return Failure(fault.problem, fault.where, remedy);
}

// Rank 0 is the host, as we start it; which node another is shows once they have booted.
std::optional<std::int32_t> node_of_rank(int rank, const std::optional<events::Booted>& booted) {
  if (!booted) return std::nullopt;
  for (const events::Booted::Node& node : booted->nodes)
    if (node.rank == rank) return node.node;
  return std::nullopt;
}

std::string name_of_rank(int rank, const std::optional<events::Booted>& booted) {
  if (rank == 0) return "the host";
  if (!booted) return "a node";
  const auto node = node_of_rank(rank, booted);
  return node ? "node " + std::to_string(*node) : "rank " + std::to_string(rank);
}

// "mpirun noticed that process rank 2 with PID 0 on node ada exited on signal 9 (Killed)."
std::optional<Diagnosis> lost_rank(const std::string& line, const std::optional<events::Booted>& booted) {
  for (TextReader words(line); words.find("process rank ");) {
    const auto rank = words.number();
    if (!rank || !words.skip(" with PID ") || !words.number() || !words.skip(" on node ")) continue;
    const auto machine = words.word();
    if (!machine || !words.skip(" exited on signal ")) continue;
    const int signal = static_cast<int>(words.number().value_or(0));
    const int number = static_cast<int>(*rank);
    return Diagnosis{
        Failure(killed_by(name_of_rank(number, booted), signal), "machine " + *machine, remedy_for(signal)),
        node_of_rank(number, booted), *machine};
  }
  return std::nullopt;
}

// MPICH's mpirun: "=   PID 17078 RUNNING AT ada", and then "... EXIT STRING: Killed (signal 9)".
std::optional<Diagnosis> lost_process(const std::string& line) {
  TextReader words(line);
  if (!words.find(" RUNNING AT ")) return std::nullopt;
  const auto machine = words.word();
  if (!machine || !words.find("EXIT STRING: ") || !words.find("(signal ")) return std::nullopt;
  const int signal = static_cast<int>(words.number().value_or(0));
  return Diagnosis{
      Failure(killed_by("the host or a node", signal), "machine " + *machine, remedy_for(signal)), {}, *machine};
}

// The machine's name, or the address itself where none is known.
std::string name_of(const std::string& address) {
  addrinfo numeric{}, *found = nullptr;
  numeric.ai_flags = AI_NUMERICHOST;
  if (getaddrinfo(address.c_str(), nullptr, &numeric, &found) != 0) return address;
  char name[NI_MAXHOST] = "";
  const int failed = getnameinfo(found->ai_addr, found->ai_addrlen, name, sizeof name, nullptr, 0, NI_NAMEREQD);
  freeaddrinfo(found);
  return failed == 0 ? name : address;
}

std::string without_port(const std::string& address) { return address.substr(0, address.rfind(':')); }

std::string machines_of(const events::Booted& booted) {
  std::set<std::string> names;
  for (const events::Booted::Node& node : booted.nodes) names.insert(node.host);
  return document::joined(names, " or ");
}

// Which machine was lost, if the words report such a loss. Open MPI has three ways to say it:
// "ORTE has lost communication with a remote daemon. ... Remote daemon: [[6456,0],2] on node n3";
// where the daemon's ssh ends first "ORTE was unable to reliably start one or more daemons", long after they have
// started; and a rank's "connect() to 10.77.0.14:1028 failed", which alone names the machine then.
std::optional<std::string> machine_lost(const std::string& line, const std::optional<events::Booted>& booted) {
  TextReader daemon(line);
  if (daemon.find("lost communication with a remote daemon") && daemon.find("Remote daemon: ") &&
      daemon.find(" on node "))
    return daemon.word();
  if (!booted) return std::nullopt;
  TextReader connection(line);
  if (connection.find("connect() to "))
    if (const auto address = connection.word()) return name_of(without_port(*address));
  if (line.find("unable to reliably start one or more daemons") != std::string::npos) return machines_of(*booted);
  return std::nullopt;
}

std::optional<Diagnosis> lost_machine(const std::string& line, const std::optional<events::Booted>& booted) {
  const std::optional<std::string> machine = machine_lost(line, booted);
  if (!machine) return std::nullopt;
  return Diagnosis{Failure("does not answer any more", "machine " + *machine,
                           "check whether it still runs and can be reached; the same command goes on"),
                   {},
                   *machine,
                   true};
}

std::string machine_of(std::int32_t node, const std::optional<events::Booted>& booted) {
  if (booted)
    for (const events::Booted::Node& each : booted->nodes)
      if (each.node == node) return each.host;
  return "";
}

Diagnosis reported(const events::Fault& fault, const std::optional<events::Booted>& booted) {
  return {failure_from(fault), fault.node, fault.node ? machine_of(*fault.node, booted) : ""};
}

// "mars: ..." is how our programs report why they end.
std::optional<Failure> own_words(const std::deque<std::string>& lines) {
  for (const std::string& line : lines) {
    if (line.starts_with("mars: ")) return Failure(line.substr(6), "", "");
  }
  return std::nullopt;
}

Failure unknown(const Remains& remains) {
  const std::string program = std::filesystem::path(remains.program).stem().string();  // mpirun.mpich is one
  if (remains.ending.signal != 0) {
    return Failure(killed_by(program, remains.ending.signal), "", remedy_for(remains.ending.signal));
  }
  const std::string how = remains.ending.code == 0 ? " ended before all frames were there"
                                                   : " ended with exit code " + std::to_string(remains.ending.code);
  const std::string words = join(remains.last_words, kShownWords);
  return Failure(program + how, "", words.empty() ? "it gave no reason" : "its last words:\n" + words);
}

// The reason why it did not start is likely to be seen from here, too.
Failure with_advice(const Failure& failure, const Advice& advice) {
  if (!advice) return failure;
  std::string remedy = failure.remedy;
  const std::string more = advice();
  if (!more.empty()) remedy += (remedy.empty() || remedy.ends_with('\n') ? "" : "\n") + more;
  return Failure(failure.problem, failure.where, remedy);
}

}  // namespace

Failure stopped(const Remains& remains, const options::RenderOptions& options) {
  return Failure("stopped by " + std::string(strsignal(remains.passed_on)) + " after " +
                     std::to_string(remains.progress.done()) + " of " + std::to_string(remains.progress.of()) +
                     " frames",
                 options.folder, "");
}

Diagnosis diagnose(const Remains& remains, const options::RenderOptions& options, const Advice& advice) {
  if (remains.passed_on != 0) return {stopped(remains, options), {}};
  if (remains.fault) return reported(*remains.fault, remains.booted);
  const auto advised = [&](const Failure& failure) { return remains.booted ? failure : with_advice(failure, advice); };
  if (!remains.ended_for.empty()) return {advised(Failure(remains.ended_for, "", "")), {}};
  if (const auto own = own_words(remains.last_words)) return {advised(*own), {}};
  const std::string words = on_one_line(join(remains.last_words, remains.last_words.size()));
  for (const auto& lost : {lost_rank(words, remains.booted), lost_process(words)})
    if (lost) return {advised(lost->failure), lost->node, lost->machine, false, true};
  if (const auto lost = lost_machine(words, remains.booted)) return *lost;
  if (const auto known = meaning_of(words)) return {*known, {}};
  return {advised(unknown(remains)), {}};
}

std::optional<std::uint32_t> frame_of_death(const Remains& remains, const Diagnosis& diagnosis) {
  if (remains.fault && remains.fault->frame) return static_cast<std::uint32_t>(*remains.fault->frame);
  if (!remains.drawing || !diagnosis.node) return std::nullopt;
  for (const events::Drawing::Node& each : remains.drawing->nodes)
    if (each.node == *diagnosis.node) return static_cast<std::uint32_t>(each.frame);
  return std::nullopt;
}

}  // namespace mars::launch
