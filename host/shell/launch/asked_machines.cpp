#include "host/shell/launch/asked_machines.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <sstream>

#include "hal/failure/failure.h"
#include "host/content/document/file.h"
#include "host/content/document/text.h"
#include "host/shell/launch/hostfile.h"

namespace mars::launch {
namespace {

struct MachineList {
  const char* variable;
  bool is_file;  // of lines that begin with a machine; else the variable holds names, and numbers of slots
};

// LSF's file may be in a folder that this machine does not see: the variables come first.
constexpr std::array kLists = {MachineList{"PBS_NODEFILE", true}, MachineList{"PE_HOSTFILE", true},
                               MachineList{"LSB_MCPU_HOSTS", false}, MachineList{"LSB_HOSTS", false},
                               MachineList{"LSB_DJOB_HOSTFILE", true}};

// A name that is given again has further slots.
void add(std::vector<Slots>& machines, const std::string& name, std::optional<std::uint32_t> slots) {
  const std::uint32_t more = std::min(slots.value_or(1), kMostSlots);
  const auto known = std::ranges::find(machines, name, &Slots::host);
  if (known != machines.end())
    known->count = std::min(known->count + more, kMostSlots);
  else if (more > 0)
    machines.push_back({name, more});
}

std::string text_of(const MachineList& list, const std::string& file) try {
  return document::read_file(file);
} catch (const Failure& failure) {
  throw Failure("the machines of the job cannot be read from " + std::string(list.variable) + ": " + failure.problem,
                file, "name them by --hostfile, or unset " + std::string(list.variable));
}

// A line a slot, "n1", or a line a machine, "n1 4 all.q".
std::vector<Slots> machines_of_lines(const std::string& text) {
  std::vector<Slots> machines;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string name, slots;
    words >> name >> slots;
    if (!name.empty()) add(machines, name, document::number_in<std::uint32_t>(slots));
  }
  return machines;
}

// "n1 n1 n2", or "n1 2 n2 1".
std::vector<Slots> machines_of_words(const std::string& words) {
  std::vector<Slots> machines;
  std::istringstream reader(words);
  std::string name, next;
  for (reader >> name; !name.empty(); name = next) {
    next.clear();
    reader >> next;
    const auto slots = document::number_in<std::uint32_t>(next);
    add(machines, name, slots);
    if (!slots) continue;
    next.clear();
    reader >> next;
  }
  return machines;
}

struct BatchJob {
  std::string variable;
  std::vector<Slots> machines;
};

// As the first list that is there says. Slurm's jobs may have PBS's list too, for old scripts.
BatchJob batch_job(const child::Environment& environment) {
  if (environment.value("SLURM_JOB_ID")) return {};
  for (const MachineList& list : kLists) {
    const std::string value = environment.value(list.variable).value_or("");
    if (value.empty()) continue;
    return {list.variable, list.is_file ? machines_of_lines(text_of(list, value)) : machines_of_words(value)};
  }
  return {};
}

std::string has_machines(const std::string& job, std::size_t count) {
  return job + " has " + std::to_string(count) + " machines";
}

std::uint32_t count_in(const child::Environment& environment, const char* variable) {
  return document::number_in<std::uint32_t>(environment.value(variable).value_or("")).value_or(0);
}

// Where salloc leaves a person on the machine from which it was called, the job may have one machine, and another.
std::string slurm_job_elsewhere(const child::Environment& environment) {
  const std::uint32_t count =
      std::max(count_in(environment, "SLURM_JOB_NUM_NODES"), count_in(environment, "SLURM_NNODES"));
  if (count > 1) return has_machines("the Slurm job", count);
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
  if (const auto count = count_in(environment, "FLUX_JOB_NNODES"); count > 1)
    return has_machines("the Flux job", count);
  const BatchJob job = batch_job(environment);
  return job.machines.size() > 1 ? has_machines(job.variable, job.machines.size()) : "";
}

std::vector<Slots> named_machines(const std::string& hostfile, const child::Environment& environment) {
  if (!hostfile.empty()) return read_hostfile(hostfile);
  std::vector<Slots> machines = batch_job(environment).machines;
  return machines.size() > 1 ? machines : std::vector<Slots>();
}

}  // namespace mars::launch
