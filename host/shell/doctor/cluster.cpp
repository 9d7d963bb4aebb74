#include "host/shell/doctor/cluster.h"

#include <signal.h>
#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>

#include "host/child/environment.h"
#include "host/child/programs.h"
#include "host/content/document/shell_word.h"
#include "host/content/document/text.h"
#include "host/shell/doctor/facts.h"
#include "host/shell/doctor/round.h"
#include "host/shell/launch/asked_machines.h"
#include "host/shell/launch/between_jobs.h"
#include "host/shell/launch/command.h"

namespace mars::doctor {
namespace {

using Words = std::vector<std::string>;

std::atomic<const char*> token_here{nullptr};
static_assert(std::atomic<const char*>::is_always_lock_free);

// The signal ends this process as soon as the handler returns.
void remove_token(int signal) {
  if (const char* const file = token_here) unlink(file);
  raise(signal);
}

// A file in the folder that the machines should share, while they are asked. A signal that ends this process removes it
// too.
class Token {
 public:
  explicit Token(const std::string& folder) {
    if (folder.empty()) return;
    file_ = folder + "/.mars-doctor-XXXXXX";
    heed_signals();
    const int file = mkstemp(file_.data());
    if (file >= 0)
      close(file);
    else
      leave();
  }
  ~Token() {
    if (!file_.empty()) unlink(file_.c_str());
    leave();
  }
  Token(const Token&) = delete;
  Token& operator=(const Token&) = delete;

  const std::string& file() const { return file_; }  // "": none can be written

 private:
  static constexpr std::array kSignals = {SIGINT, SIGTERM, SIGHUP};

  // Ignored ones, as under nohup, stay ignored.
  void heed_signals() {
    token_here = file_.c_str();
    struct sigaction action {};
    action.sa_handler = remove_token;
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    for (std::size_t i = 0; i < kSignals.size(); ++i) {
      sigaction(kSignals[i], nullptr, &before_[i]);
      if (before_[i].sa_handler != SIG_IGN) sigaction(kSignals[i], &action, nullptr);
    }
  }

  void leave() {
    if (file_.empty()) return;
    for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &before_[i], nullptr);
    token_here = nullptr;
    file_.clear();
  }

  std::string file_;
  std::array<struct sigaction, 3> before_{};
};

// How machines are asked, as mpirun would start their ranks.
struct Way {
  std::optional<std::filesystem::path> srun, ssh;
  std::string self;
  std::string token;
};

Words doctor_words(const Way& way, std::uint32_t nodes) {
  Words words{way.self, "doctor", "--this-machine", "--nodes", std::to_string(std::max(nodes, 1u))};
  if (!way.token.empty()) words.insert(words.end(), {"--token", way.token});
  return words;
}

Words named(Words words, const std::string& host) {
  words.insert(words.end(), {"--own-name", host});
  return words;
}

// The settings that mpirun hands on, too: shells of ssh read few files.
Words with_settings(const Words& words) {
  const child::Environment environment = child::own_environment();
  Words all{"env"};
  Words names{"PATH", "LD_LIBRARY_PATH"};
  for (const std::string& name : launch::look_around("", launch::Ask::no_programs).settings) names.push_back(name);
  for (const std::string& name : names)
    if (const auto value = environment.value(name)) all.push_back(name + "=" + *value);
  all.insert(all.end(), words.begin(), words.end());
  return all;
}

Call call_by_ssh(const Way& way, const launch::Slots& machine) {
  Words words = with_settings(named(doctor_words(way, machine.count), machine.host));
  std::ranges::transform(words, words.begin(), document::shell_word);
  return {{machine.host},
          {{},
           {way.ssh->string(), "-o", "BatchMode=yes", "-o", "ConnectTimeout=5", "--", machine.host,
            document::joined(words, " ")}}};
}

// The least of "4(x3),2", processors by machine: what a step may ask of every machine.
std::uint32_t least_processors(const child::Environment& environment) {
  const auto each = launch::tasks_of_machines(environment.value("SLURM_JOB_CPUS_PER_NODE").value_or("1"));
  return each.empty() ? 1 : *std::ranges::min_element(each);
}

// One step, whose tasks all read our words.
Call call_by_srun(const Way& way, const std::vector<launch::Slots>& machines) {
  Words names;
  for (const launch::Slots& each : machines) names.push_back(each.host);
  const std::string count = std::to_string(names.size());
  Words words{way.srun->string(),
              "--overlap",
              "--mpi=none",
              "--export=ALL",
              "--nodes=" + count,
              "--ntasks=" + count,
              "--ntasks-per-node=1",
              "--cpus-per-task=" + std::to_string(least_processors(child::own_environment())),
              "--nodelist=" + document::joined(names, ",")};
  const std::uint32_t nodes = std::ranges::max(machines, {}, &launch::Slots::count).count;
  for (const std::string& word : doctor_words(way, nodes)) words.push_back(word);
  return {names, {{}, words}};
}

// This machine knocks, too, where none of the ranks will be on it: mpirun is.
std::vector<Call> calls_for(const Way& way, const std::vector<launch::Slots>& machines) {
  std::vector<Call> calls;
  bool is_asked = false;
  if (way.srun) calls.push_back(call_by_srun(way, machines));
  for (const launch::Slots& each : machines) {
    const bool here = launch::is_here(each.host);
    is_asked = is_asked || here;
    if (way.srun) continue;
    if (here)
      calls.push_back({{each.host}, {{}, named(doctor_words(way, each.count), each.host)}});
    else
      calls.push_back(call_by_ssh(way, each));
  }
  if (!is_asked) calls.push_back({{host_name()}, {{}, named(doctor_words(way, 1), host_name())}});
  return calls;
}

std::vector<launch::Slots> machines_of(const std::string& hostfile) {
  const child::Environment environment = child::own_environment();
  const std::vector<launch::Slots> named = launch::named_machines(hostfile, environment);
  return !named.empty() || !hostfile.empty() ? named
                                             : launch::slurm_machines(environment, child::program_path(environment));
}

}  // namespace

std::optional<Cluster> look_at_machines(const std::string& hostfile, const std::string& folder,
                                        const std::filesystem::path& self) {
  const std::vector<launch::Slots> machines = machines_of(hostfile);
  if (std::ranges::all_of(machines, launch::is_here, &launch::Slots::host)) return std::nullopt;
  const std::string path = child::program_path(child::own_environment());
  const Token token(folder);
  Way way{{}, child::find_program("ssh", path), self.string(), token.file()};
  if (child::own_environment().value("SLURM_JOB_ID")) way.srun = child::find_program("srun", path);
  if (!way.ssh && !way.srun)
    return Cluster{{},
                   {{Finding::State::trouble, "machines", "others cannot be asked: ssh was not found",
                     "install it (Debian: openssh-client)"}},
                   ""};
  const Round round = go_round(calls_for(way, machines), way.self);
  Cluster cluster{{}, round.silences, document::joined(who_cannot_reach(round.answers.missed), "; ")};
  for (const Finding& each : check_together(round.answers)) cluster.findings.push_back(each);
  std::ranges::copy_if(round.answers.findings, std::back_inserter(cluster.machines), [&](const MachineFindings& each) {
    return std::ranges::count(machines, each.host, &launch::Slots::host) > 0;
  });
  if (!folder.empty() && token.file().empty())
    cluster.findings.push_back({Finding::State::note, "folder", folder + " cannot be written by this machine",
                                "name another folder: mars doctor -o DIR"});
  return cluster;
}

}  // namespace mars::doctor
