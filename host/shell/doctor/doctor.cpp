#include "host/shell/doctor/doctor.h"

#include <algorithm>
#include <charconv>
#include <iostream>

#include "host/child/child.h"
#include "host/child/environment.h"
#include "host/child/programs.h"
#include "host/shell/doctor/show.h"
#include "host/shell/launch/asked_machines.h"

namespace mars::doctor {
namespace {

// The least of "4(x3),2", processors by machine: what a step may ask of every machine.
std::uint32_t least_processors(const std::string& text) {
  std::uint32_t least = 0;
  for (std::size_t at = 0; at < text.size(); at = std::min(text.find(',', at), text.size() - 1) + 1) {
    std::uint32_t processors = 0;
    std::from_chars(text.data() + at, text.data() + text.size(), processors);
    if (processors != 0 && (least == 0 || processors < least)) least = processors;
  }
  return std::max(least, 1u);
}

// A doctor on every machine of the job, with as many processors as it gives.
child::Command ask_all(const std::filesystem::path& srun, const SlurmJob& job, std::uint32_t nodes_each,
                       const std::filesystem::path& self) {
  const std::string machines = std::to_string(job.machines);
  const std::string given = child::own_environment().value("SLURM_JOB_CPUS_PER_NODE").value_or("1");
  return {{},
          {srun.string(), "--overlap", "--mpi=none", "--nodes=" + machines, "--ntasks=" + machines,
           "--ntasks-per-node=1", "--cpus-per-task=" + std::to_string(least_processors(given)), self.string(), "doctor",
           "--this-machine", "--nodes", std::to_string(nodes_each)}};
}

struct Answers {
  std::vector<MachineFindings> machines;
  std::string complaints;
};

Answers ask(const child::Command& command) {
  constexpr std::chrono::seconds kLongest{60};
  const auto deadline = std::chrono::steady_clock::now() + kLongest;
  Answers answers;
  child::Child child(command);
  child.wait({[&](const std::string& line) { add_line(line, answers.machines); },
              [&](const std::string& line) { answers.complaints += line + "\n"; },
              [&] {
                if (std::chrono::steady_clock::now() > deadline) child.stop();
              }});
  child::fail_if_stopped(child);
  return answers;
}

// All machines of the job, this one only where the others cannot be asked.
std::vector<MachineFindings> look_at_all(const Facts& facts, std::vector<Finding>& findings,
                                         const std::filesystem::path& self) {
  const std::vector<MachineFindings> here{{facts.host, check_machine(facts)}};
  if (!facts.slurm || facts.slurm->machines < 2) return here;
  const auto srun = child::find_program("srun", child::program_path(child::own_environment()));
  if (!srun) return here;
  const std::uint32_t machines = facts.slurm->machines;
  Answers answers = ask(ask_all(*srun, *facts.slurm, (facts.nodes + machines - 1) / machines, self));
  if (answers.machines.size() < machines) {
    std::vector<std::string> names;
    for (const MachineFindings& machine : answers.machines) names.push_back(machine.host);
    findings.push_back({Finding::State::trouble, "machines",
                        std::to_string(names.size()) + " of " + std::to_string(machines) + " answered" +
                            (names.empty() ? "" : ": " + host_list(names)),
                        "srun must reach every machine of the job, and MARS be under the same path on each" +
                            (answers.complaints.empty() ? "" : "; it says:\n" + answers.complaints)});
  }
  return answers.machines.empty() ? here : answers.machines;
}

// None where there is nothing to start, which the checks report.
std::optional<launch::Trial> try_to_start(const DoctorOptions& options, const launch::Programs& programs,
                                          const std::filesystem::path& self) {
  const bool mpi = programs.mpirun && programs.host && programs.node;
  const bool threads = programs.threads && launch::asked_machines("", child::own_environment()).empty();
  if (!mpi && !threads) return std::nullopt;
  options::RenderOptions render;
  render.nodes = options.nodes;
  return launch::try_start(render, self);
}

std::string names_of(const std::vector<MachineFindings>& machines) {
  std::vector<std::string> names;
  for (const MachineFindings& machine : machines) names.push_back(machine.host);
  return host_list(names);
}

}  // namespace

bool run_doctor(const DoctorOptions& options, const std::filesystem::path& self) {
  Facts facts = gather_facts(self, options.nodes, launch::Ask::programs);
  if (options.this_machine) {
    std::cout << lines_of({facts.host, check_machine(facts)}) << std::flush;
    return true;
  }
  const std::optional<launch::Trial> trial = try_to_start(options, facts.programs, self);
  if (trial && !trial->booted.nodes.empty()) facts.nodes = static_cast<std::uint32_t>(trial->booted.nodes.size());
  std::vector<Finding> findings;
  const std::vector<MachineFindings> machines = look_at_all(facts, findings, self);
  for (const Finding& finding : grouped(machines)) findings.push_back(finding);
  if (trial) findings.push_back(check_start(*trial));
  std::cout << "MARS " << options.version << " on " << names_of(machines) << "\n" << text_of(findings);
  if (options.nodes != 0) {
    std::cout << placement_text(topology::Machine::here(), static_cast<int>(options.nodes), options.reserved_cores);
  }
  std::cout << verdict(findings) << "\n";
  return !in_trouble(findings);
}

launch::Adviser adviser(const std::filesystem::path& self) {
  const auto question = [self](launch::Ask ask) {
    return [self, ask](const options::RenderOptions& options) {
      return short_text(check_machine(gather_facts(self, options.nodes, ask)));
    };
  };
  return {question(launch::Ask::no_programs), question(launch::Ask::programs)};
}

}  // namespace mars::doctor
