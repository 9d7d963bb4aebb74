#include "host/shell/launch/asked_machines.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <set>
#include <sstream>
#include <string_view>

#include "host/content/document/text.h"
#include "host/shell/launch/hostfile.h"

namespace mars::launch {
namespace {

struct MachineList {
  const char* variable;
  bool is_file;  // of lines that begin with a machine; else the variable holds names, and numbers of slots
};

constexpr std::array kLists = {MachineList{"PBS_NODEFILE", true}, MachineList{"PE_HOSTFILE", true},
                               MachineList{"LSB_DJOB_HOSTFILE", true}, MachineList{"LSB_HOSTS", false},
                               MachineList{"LSB_MCPU_HOSTS", false}};

std::set<std::string> names_in(const std::string& file) {
  std::set<std::string> names;
  std::ifstream lines(file);
  for (std::string line, name; std::getline(lines, line);)
    if (std::istringstream(line) >> name) names.insert(name);
  return names;
}

std::set<std::string> names_among(const std::string& words) {
  std::set<std::string> names;
  std::istringstream reader(words);
  for (std::string word; reader >> word;)
    if (!document::number_in<std::uint32_t>(word)) names.insert(word);
  return names;
}

std::string has_machines(const std::string& job, std::size_t count) {
  return job + " has " + std::to_string(count) + " machines";
}

// Where salloc leaves a person on the machine from which it was called, the job may have one machine, and another.
std::string slurm_job_elsewhere(const child::Environment& environment) {
  const auto count = document::number_in<std::uint32_t>(environment.value("SLURM_JOB_NUM_NODES").value_or(""));
  if (count.value_or(1) > 1) return has_machines("the Slurm job", *count);
  const auto list = environment.value("SLURM_JOB_NODELIST");
  const bool elsewhere = list && !environment.value("SLURMD_NODENAME") && !is_here(*list);
  return elsewhere ? "the Slurm job has the machine " + *list : "";
}

}  // namespace

bool batch_lists_machines(const child::Environment& environment) {
  return std::ranges::any_of(kLists,
                             [&](const MachineList& list) { return environment.value(list.variable).has_value(); });
}

std::string asked_machines(const std::string& hostfile, const child::Environment& environment) {
  if (!hostfile.empty()) {
    const std::vector<Slots> machines = read_hostfile(hostfile);
    const bool here = !machines.empty() && std::ranges::all_of(machines, is_here, &Slots::host);
    return here ? "" : hostfile + " names other machines";
  }
  if (const std::string job = slurm_job_elsewhere(environment); !job.empty()) return job;
  for (const MachineList& list : kLists) {
    const auto value = environment.value(list.variable);
    const std::size_t count = !value ? 0 : (list.is_file ? names_in(*value) : names_among(*value)).size();
    if (count > 1) return has_machines(list.variable, count);
  }
  return "";
}

}  // namespace mars::launch
