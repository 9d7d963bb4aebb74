#include "host/shell/doctor/doctor.h"

#include <iostream>

#include "host/shell/doctor/asked.h"
#include "host/shell/doctor/cluster.h"
#include "host/shell/doctor/show.h"

namespace mars::doctor {
namespace {

// None where there is nothing to start, which the checks report.
std::optional<launch::Trial> try_to_start(const DoctorOptions& options, const launch::Programs& programs,
                                          const std::filesystem::path& self) {
  if (!programs.threads && !(programs.mpirun && programs.host && programs.node)) return std::nullopt;
  options::RenderOptions render;
  render.nodes = options.nodes;
  render.hostfile = options.hostfile;
  return launch::try_start(render, self);
}

std::string names_of(const std::vector<MachineFindings>& machines) {
  std::vector<std::string> names;
  for (const MachineFindings& machine : machines) names.push_back(machine.host);
  return host_list(names);
}

std::vector<Finding> all_of(const Cluster& cluster) {
  std::vector<Finding> findings = cluster.findings;
  for (const Finding& each : grouped(cluster.machines)) findings.push_back(each);
  return findings;
}

// For a run that waits: the first line is what keeps machines apart.
std::string advice_about(const Cluster& cluster) {
  const std::vector<Finding> findings = all_of(cluster);
  if (in_trouble(findings)) return cluster.cut_off + "\n" + short_text(findings);
  return "\nall machines answer, and reach each other by TCP: " + names_of(cluster.machines);
}

}  // namespace

bool run_doctor(const DoctorOptions& options, const std::filesystem::path& self) {
  if (options.this_machine) {
    answer_doctor(options, self);
    return true;
  }
  const std::optional<Cluster> cluster = look_at_machines(options.hostfile, options.folder, self);
  std::vector<Finding> findings = cluster ? cluster->findings : std::vector<Finding>();
  Facts facts = gather_facts(self, options.nodes, launch::Ask::programs);
  std::optional<launch::Trial> trial;  // over machines in trouble it would only wait long
  if (!in_trouble(findings)) trial = try_to_start(options, facts.programs, self);
  if (trial && !trial->booted.nodes.empty()) facts.nodes = static_cast<std::uint32_t>(trial->booted.nodes.size());
  const bool alone = !cluster || cluster->machines.empty();
  const std::vector<MachineFindings> here{{facts.host, check_machine(facts)}};
  const std::vector<MachineFindings>& machines = alone ? here : cluster->machines;
  for (const Finding& finding : grouped(machines)) findings.push_back(finding);
  for (const Finding& finding : check_job(facts)) findings.push_back(finding);
  if (trial) findings.push_back(check_start(*trial));
  std::cout << "MARS " << options.version << " on " << names_of(machines) << "\n" << text_of(findings);
  if (options.nodes != 0) {
    std::cout << placement_text(topology::Machine::here(), static_cast<int>(options.nodes), options.reserved_cores);
  }
  std::cout << verdict(findings) << "\n";
  return !in_trouble(findings);
}

launch::Adviser adviser(const std::filesystem::path& self) {
  const auto here = [self](const options::RenderOptions& options, launch::Ask ask) {
    const Facts facts = gather_facts(self, options.nodes, ask);
    std::vector<Finding> findings = check_machine(facts);
    for (const Finding& each : check_job(facts)) findings.push_back(each);
    return findings;
  };
  return {[here](const options::RenderOptions& options) { return short_text(here(options, launch::Ask::no_programs)); },
          [here, self](const options::RenderOptions& options) {
            std::vector<Finding> findings = here(options, launch::Ask::programs);
            if (const auto cluster = look_at_machines(options.hostfile, {}, self)) findings = all_of(*cluster);
            return short_text(findings);
          },
          [self](const options::RenderOptions& options) {
            const auto cluster = look_at_machines(options.hostfile, {}, self);
            return cluster ? advice_about(*cluster) : "";
          }};
}

}  // namespace mars::doctor
