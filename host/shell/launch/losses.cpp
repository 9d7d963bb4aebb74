#include "host/shell/launch/losses.h"

#include <netdb.h>
#include <signal.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <set>

#include "host/content/document/text.h"
#include "host/shell/launch/mpi_words.h"
#include "host/shell/launch/slots.h"
#include "host/shell/launch/text_reader.h"

namespace mars::launch {
namespace {

constexpr int kCodeOfSignals = 128;  // and the signal's number: how shells and MPIs write it as an exit code
constexpr int kSignals = 32;         // that have a meaning of their own
constexpr int kCodeOfSsh = 255;      // also where a signal ended what it had started
constexpr const char* kNoConnection = "connect() to ";
constexpr const char* kNoDaemon = "unable to reliably start one or more daemons";

// Those that end no process by themselves.
constexpr std::array kHarmless = {SIGCHLD, SIGCONT, SIGSTOP, SIGTSTP, SIGTTIN, SIGTTOU, SIGURG, SIGWINCH};

// 0: it stands for none.
int signal_of_code(int code) {
  const int signal = code - kCodeOfSignals;
  if (signal <= 0 || signal >= kSignals) return 0;
  return std::count(kHarmless.begin(), kHarmless.end(), signal) == 0 ? signal : 0;
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
  if (signal == SIGTERM || signal == SIGINT || signal == SIGHUP)
    return "look for what ends it: a batch system, a person";
  return "please report it with the film";
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
std::optional<Loss> lost_rank(const std::string& line, const std::optional<events::Booted>& booted) {
  for (TextReader words(line); words.find("process rank ");) {
    const auto rank = words.number();
    if (!rank || !words.skip(" with PID ") || !words.number() || !words.skip(" on node ")) continue;
    const auto machine = words.word();
    if (!machine || !words.skip(" exited on signal ")) continue;
    const int signal = static_cast<int>(words.number().value_or(0));
    const int number = static_cast<int>(*rank);
    return Loss{Failure(killed_by(name_of_rank(number, booted), signal), "machine " + *machine, remedy_for(signal)),
                node_of_rank(number, booted), *machine};
  }
  return std::nullopt;
}

// MPICH's mpirun: "=   PID 17078 RUNNING AT ada", and then "... EXIT STRING: Killed (signal 9)".
std::optional<Loss> lost_process(const std::string& line) {
  TextReader words(line);
  if (!words.find(" RUNNING AT ")) return std::nullopt;
  const auto machine = words.word();
  if (!machine || !words.find("EXIT STRING: ") || !words.find("(signal ")) return std::nullopt;
  const int signal = static_cast<int>(words.number().value_or(0));
  return Loss{
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
  for (const events::Booted::Node& node : booted.nodes)
    if (!is_here(node.host)) names.insert(node.host);
  return document::joined(names, " or ");
}

// The first other machine to which a connection failed. What a dying machine says of its own connections names this
// one, which is not lost.
std::optional<std::string> machine_without_connection(const std::string& line) {
  for (TextReader words(line); words.find(kNoConnection);) {
    const auto address = words.word();
    if (!address) return std::nullopt;
    if (const std::string name = name_of(without_port(*address)); !is_here(name)) return name;
  }
  return std::nullopt;
}

// Which machine was lost, if the words report such a loss. Open MPI has three ways to say it:
// "ORTE has lost communication with a remote daemon. ... Remote daemon: [[6456,0],2] on node n3";
// where the daemon's ssh ends first "ORTE was unable to reliably start one or more daemons", long after they have
// started; and a rank's "connect() to 10.77.0.14:1028 failed", which alone names the machine then.
std::optional<std::string> machine_lost(const std::string& line, const std::optional<events::Booted>& booted) {
  TextReader daemon(line);
  if (daemon.find("lost communication with a remote daemon") && daemon.find("Remote daemon: ") &&
      daemon.find(" on node "))
    if (const auto name = daemon.word(); name && !is_here(*name)) return name;
  if (!booted) return std::nullopt;
  if (const auto name = machine_without_connection(line)) return name;
  const bool lost = line.find(kNoDaemon) != std::string::npos || line.find(kNoConnection) != std::string::npos;
  const std::string others = lost ? machines_of(*booted) : "";
  return others.empty() ? std::nullopt : std::optional(others);
}

std::optional<Loss> lost_machine(const std::string& line, const std::optional<events::Booted>& booted) {
  const std::optional<std::string> machine = machine_lost(line, booted);
  if (!machine) return std::nullopt;
  return Loss{Failure("does not answer any more", "machine " + *machine,
                      "check whether it still runs and can be reached; the same command goes on"),
              {},
              *machine,
              true};
}

// The rest of a line of srun's behind its task's number: "Killed", "Out Of Memory", "Exited with exit code 137"; 0:
// none ended it.
int signal_of_task(TextReader words) {
  if (words.skip("Exited with exit code ")) return signal_of_code(static_cast<int>(words.number().value_or(0)));
  if (words.skip("Out Of Memory")) return SIGKILL;
  for (int signal = 1; signal < kSignals; ++signal)
    if (words.skip(strsignal(signal))) return signal;
  return 0;
}

// "srun: error: n3: task 1: Killed", or "srun: error: n[2-3]: tasks 1-2: Killed": Open MPI's daemons are Slurm's tasks.
std::optional<Loss> lost_task(const std::string& line) {
  for (TextReader words(line); words.find("srun: error: ");) {
    const auto machine = words.word();
    if (!machine || !machine->ends_with(':') || !(words.skip(" task ") || words.skip(" tasks ")) || !words.word())
      continue;
    words.skip_space();
    const int signal = signal_of_task(words);
    if (signal == 0) continue;
    const std::string name = machine->substr(0, machine->size() - 1);
    return Loss{Failure(killed_by("Open MPI's daemon", signal), "machine " + name, remedy_for(signal)),
                {},
                name.find('[') == std::string::npos ? name : ""};
  }
  return std::nullopt;
}

// "ORTE was unable to reliably start one or more daemons": of one that died on its way, mpirun gives its signal as exit
// code, or the exit code of the ssh or shell that had started it.
std::optional<Loss> lost_daemon(const std::string& line, const child::Ending& ending) {
  if (line.find(kNoDaemon) == std::string::npos) return std::nullopt;
  const bool in_order = ending.code <= SIGINT || ending.code >= kSignals;  // 1 and 2 are also what programs give
  const int signal = in_order ? signal_of_code(ending.code) : ending.code;
  if (signal != 0)
    return Loss{Failure(killed_by("Open MPI's daemon on another machine", signal), "", remedy_for(signal))};
  if (ending.code == kCodeOfSsh)
    if (const auto meaning = meaning_of(line)) return Loss{*meaning};
  return std::nullopt;
}

// While a job starts, a link that is down for some seconds ends it with the words of a closed port: the next start
// shows which of both it was.
std::optional<Loss> lost_connection(const std::string& line) {
  if (line.find(kNoDaemon) != std::string::npos) return std::nullopt;
  for (const char* words : {kNoConnection, "unable to complete a TCP connection"})
    if (line.find(words) != std::string::npos)
      if (const auto meaning = meaning_of(line)) return Loss{*meaning};
  return std::nullopt;
}

// Two jobs that begin at once both make Open MPI's folder on a machine, and one of them fails.
std::optional<Loss> lost_folder(const std::string& line) {
  TextReader words(line);
  if (!words.find("call to mkdir was unable to create") || !words.find("Error: File exists")) return std::nullopt;
  return Loss{Failure("another job made Open MPI's folder at the same time", "", "start it again")};
}

// "An MPI communication peer process has unexpectedly disconnected. ... Peer host: n2": of a process that died, or
// behind a link that was down. Which end of the connection failed it does not say.
std::optional<Loss> lost_peer(const std::string& line) {
  TextReader words(line);
  if (!words.find("peer process has unexpectedly disconnected")) return std::nullopt;
  const auto machine = words.find("Peer host: ") ? words.word() : std::nullopt;
  return Loss{Failure("a connection between processes broke", machine ? "machine " + *machine : "",
                      "look whether a process was ended there, and whether the network is sound")};
}

// What Open MPI cannot start has an exit code of its own, from 129 on too.
bool never_started(const std::string& words) {
  for (const char* way : {"find", "launch", "start"})
    if (words.find(" was unable to " + std::string(way) + " the specified ") != std::string::npos) return true;
  return false;
}

// Connections also break, and daemons end, where a process leaves for a reason that it gives.
std::optional<Loss> loss_in_words(const Remains& remains, const std::string& words) {
  const bool explained = remains.gave_reason();
  if (auto loss = lost_rank(words, remains.booted)) return loss;
  if (auto loss = lost_process(words)) return loss;
  if (auto loss = lost_machine(words, remains.booted); loss && !explained) return loss;
  if (auto loss = lost_task(words)) return loss;
  if (explained) return std::nullopt;
  if (auto loss = lost_daemon(words, remains.ending)) return loss;
  if (auto loss = lost_folder(words)) return loss;
  if (auto loss = lost_connection(words)) return loss;
  return lost_peer(words);
}

// libevent, in which mpirun waits, warns of what is closed while it ends.
bool gives_no_reason(const std::deque<std::string>& lines) {
  return std::ranges::all_of(lines,
                             [](const std::string& line) { return line.empty() || line.starts_with("[warn] "); });
}

// Open MPI has no words for a process that dies while others still start.
std::optional<Failure> loss_by_ending(const Remains& remains, const std::string& words) {
  const auto [code, signal] = remains.ending;
  const std::string program = std::filesystem::path(remains.program).stem().string();  // mpirun.mpich is one
  if (signal != 0) return Failure(killed_by(program, signal), "", remedy_for(signal));
  const int other = signal_of_code(code);
  if (other != 0 && !never_started(words) && !remains.gave_reason())
    return Failure(killed_by("the host or a node", other), "", remedy_for(other));
  // mpirun ends so when a signal asks it to end.
  if (code == 1 && gives_no_reason(remains.last_words) && !remains.fault)
    return Failure(program + " ended with exit code 1 and gave no reason", "", remedy_for(SIGTERM));
  return std::nullopt;
}

}  // namespace

std::optional<Loss> find_loss(const Remains& remains, const std::string& words) {
  if (auto loss = loss_in_words(remains, words)) return loss;
  const auto failure = loss_by_ending(remains, words);
  if (!failure) return std::nullopt;
  return Loss{.failure = *failure, .in_words = false};
}

}  // namespace mars::launch
