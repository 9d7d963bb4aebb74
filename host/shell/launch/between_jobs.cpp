#include "host/shell/launch/between_jobs.h"

#include <functional>

#include "host/child/child.h"
#include "host/child/programs.h"
#include "host/shell/launch/command.h"
#include "host/shell/launch/text_reader.h"

namespace mars::launch {
namespace {

constexpr std::chrono::seconds kLongestAnswer{10};

// All machines at once: each answer is a line. The words: seconds of the pause, ssh, machines.
constexpr const char* kAskBySsh = R"(sleep "$1" & ssh=$2; shift 2
for machine; do
  ("$ssh" -o BatchMode=yes -o ConnectTimeout=5 -- "$machine" true && echo "$machine" up) </dev/null 2>/dev/null &
done
wait)";

// The words: seconds of the pause, sinfo, the machines between commas.
constexpr const char* kAskSlurm = R"(sleep "$1" & "$2" --noheader --Node --nodes="$3" --format="%N %T"; wait)";

// Passes on its output line by line, until it ends or the longest time is over.
void run_for(const std::vector<std::string>& words, std::chrono::milliseconds longest,
             const std::function<void(const std::string&)>& line) {
  child::Child child({{}, words});
  child::wait_at_most(child, longest, line, [](const std::string&) {});
}

std::vector<std::string> words_for(const Pause& pause, const std::string& path) {
  const std::string seconds = std::to_string(pause.length.count());
  const auto ssh = child::find_program("ssh", path), sinfo = child::find_program("sinfo", path);
  if (pause.question == Question::ssh && ssh) {
    std::vector<std::string> words{"/bin/sh", "-c", kAskBySsh, "sh", seconds, ssh->string()};
    for (const std::string& machine : pause.machines)
      if (!is_here(machine)) words.push_back(machine);
    return words;
  }
  if (pause.question == Question::slurm && sinfo) {
    std::string list;
    for (const std::string& machine : pause.machines) list += (list.empty() ? "" : ",") + machine;
    return {"/bin/sh", "-c", kAskSlurm, "sh", seconds, sinfo->string(), list};
  }
  return {"/bin/sleep", seconds};
}

}  // namespace

std::set<std::string> wait_and_ask(const Pause& pause, const std::string& path) {
  const std::vector<std::string> words = words_for(pause, path);
  const bool asked = words.front() == "/bin/sh";
  std::set<std::string> answering;
  for (const std::string& machine : pause.machines)
    if (!asked || is_here(machine)) answering.insert(machine);
  run_for(words, pause.length + kLongestAnswer, [&](const std::string& line) {
    TextReader answer(line);
    const auto machine = answer.word();
    answer.skip_space();
    const auto state = answer.word();
    if (machine && state && usable(*state)) answering.insert(*machine);
  });
  return answering;
}

std::vector<Slots> slurm_machines(const child::Environment& environment, const std::string& path) {
  const auto list = environment.value("SLURM_JOB_NODELIST");
  const auto scontrol = child::find_program("scontrol", path);
  if (!list || !scontrol) return {};
  const auto tasks = tasks_of_machines(environment.value("SLURM_TASKS_PER_NODE").value_or(""));
  std::vector<Slots> machines;
  run_for({scontrol->string(), "show", "hostnames", *list}, kLongestAnswer, [&](const std::string& name) {
    if (machines.size() < tasks.size()) machines.push_back({name, tasks[machines.size()]});
  });
  return machines;
}

bool is_preempted(const child::Environment& environment, const std::string& path) {
  const auto job = environment.value("SLURM_JOB_ID");
  const auto scontrol = child::find_program("scontrol", path);
  if (!job || !scontrol) return false;
  bool preempted = false;
  run_for({scontrol->string(), "show", "job", *job}, kLongestAnswer,
          [&](const std::string& line) { preempted = preempted || tells_preemption(line); });
  return preempted;
}

// "PreemptTime=2026-01-31T12:00:00"; of others None.
bool tells_preemption(const std::string& scontrol_line) {
  TextReader line(scontrol_line);
  return line.find("PreemptTime=") && line.number();
}

// "down*": it does not answer. What drains finishes the jobs that it has.
bool usable(const std::string& slurm_state) {
  if (slurm_state.ends_with('*')) return false;
  for (const char* gone : {"down", "fail", "unk", "no_resp", "power", "boot", "reboot"})
    if (slurm_state.starts_with(gone)) return false;
  return true;
}

}  // namespace mars::launch
