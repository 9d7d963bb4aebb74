#include "host/shell/doctor/doctor.h"

#include <unistd.h>

#include <algorithm>
#include <iostream>

#include "host/child/environment.h"
#include "host/content/document/checksum.h"
#include "host/content/document/file.h"
#include "host/shell/doctor/answers.h"
#include "host/shell/doctor/cluster.h"
#include "host/shell/doctor/show.h"
#include "host/shell/launch/asked_machines.h"

namespace mars::doctor {
namespace {

using State = Finding::State;

// None where there is nothing to start, which the checks report.
std::optional<launch::Trial> try_to_start(const DoctorOptions& options, const launch::Programs& programs,
                                          const std::filesystem::path& self) {
  const bool mpi = programs.mpirun && programs.host && programs.node;
  const bool threads = programs.threads && launch::asked_machines(options.hostfile, child::own_environment()).empty();
  if (!mpi && !threads) return std::nullopt;
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

// It must be the same on all machines; it is about the job as a whole.
bool is_shared(const Finding& finding) { return finding.about == "MARS" || finding.about == "MPI"; }
bool is_of_job(const Finding& finding) { return finding.about == "Slurm" || finding.about == "srun"; }

// Where machines are asked, this one need not be one of them, but it starts the job.
bool is_of_start(const Finding& finding) {
  return is_of_job(finding) || (finding.about == "MPI" && finding.state == State::trouble);
}

std::vector<Finding> all_of(const Cluster& cluster) {
  std::vector<Finding> findings = cluster.findings;
  for (Finding each : grouped(cluster.machines)) {
    const auto is_alike = [&](const MachineFindings& machine) {
      return std::ranges::count(machine.findings, each) > 0;
    };
    if (is_shared(each) && each.state != State::trouble && !std::ranges::all_of(cluster.machines, is_alike))
      each = {State::trouble, each.about, each.found, "install the same under the same path on every machine"};
    findings.push_back(each);
  }
  return findings;
}

// For a run that waits: the first line is what keeps machines apart.
std::string advice_about(const Cluster& cluster) {
  const std::vector<Finding> findings = all_of(cluster);
  if (in_trouble(findings)) return cluster.cut_off + "\n" + short_text(findings);
  return "\nall machines answer, and reach each other by TCP: " + names_of(cluster.machines);
}

// About this machine, for the doctor of another one.
MachineFindings findings_for_another(const DoctorOptions& options, const std::filesystem::path& self) {
  constexpr std::size_t kShownDigits = 8;
  Facts facts = gather_facts(self, options.nodes, launch::Ask::programs);
  facts.has_others = true;
  if (facts.slurm) facts.slurm->tasks = 0;  // they are those of this visit
  MachineFindings own{options.own_name, check_machine(facts)};
  std::erase_if(own.findings, is_of_job);
  if (facts.programs.node) {
    const std::string node = document::read_file(*facts.programs.node);
    const std::string checksum = document::checksum_of(std::as_bytes(std::span(node))).substr(0, kShownDigits);
    own.findings.push_back({State::good, "MARS", options.version + ", mars-node " + checksum, ""});
  }
  if (options.token.empty()) return own;
  const std::string folder = std::filesystem::path(options.token).parent_path().string();
  own.findings.push_back(document::file_exists(options.token)
                             ? Finding{State::good, "folder", folder + " is the same on all machines", ""}
                             : Finding{State::note, "folder",
                                       folder + " is not the folder that the machine of this command sees",
                                       "render into a folder that all machines share, or use --write host"});
  return own;
}

// Answers on standard output, and stays until standard input ends; a minute at most.
void answer_another(DoctorOptions options, const std::filesystem::path& self) {
  constexpr unsigned kLongestVisit = 60;
  constexpr std::chrono::seconds kPatience{3};
  alarm(kLongestVisit);
  // Slurm names the machine as its list of machines does.
  if (options.own_name.empty())
    options.own_name = child::own_environment().value("SLURMD_NODENAME").value_or(host_name());
  const Door door;
  std::cout << lines_of(findings_for_another(options, self))
            << door_line({options.own_name, door.port(), own_addresses()}) << std::flush;
  std::string line;
  std::getline(std::cin, line);
  std::cout << clock_line(options.own_name, std::chrono::system_clock::now()) << std::flush;
  for (const Missed& each : knock(options.own_name, read_doors(line), kPatience)) std::cout << missed_line(each);
  std::cout << met_line(options.own_name) << std::flush;
  while (std::getline(std::cin, line)) {  // others may still knock here
  }
}

}  // namespace

bool run_doctor(const DoctorOptions& options, const std::filesystem::path& self) {
  if (options.this_machine) {
    answer_another(options, self);
    return true;
  }
  const std::filesystem::path folder = std::filesystem::current_path() / options.folder;
  const auto cluster = look_at_machines(options.hostfile, folder.lexically_normal().string(), self);
  Facts facts = gather_facts(self, options.nodes, launch::Ask::programs);
  std::optional<launch::Trial> trial;  // over machines in trouble it would only wait long
  if (!cluster || !in_trouble(cluster->findings)) trial = try_to_start(options, facts.programs, self);
  if (trial && !trial->booted.nodes.empty()) facts.nodes = static_cast<std::uint32_t>(trial->booted.nodes.size());
  facts.has_others = cluster.has_value();
  std::vector<Finding> findings = check_machine(facts);
  std::string names = facts.host;
  if (cluster) {
    std::erase_if(findings, std::not_fn(is_of_start));
    for (const Finding& each : all_of(*cluster))
      if (std::ranges::find(findings, each) == findings.end()) findings.push_back(each);
    if (!cluster->machines.empty()) names = names_of(cluster->machines);
  }
  if (trial) findings.push_back(check_start(*trial));
  std::cout << "MARS " << options.version << " on " << names << "\n" << text_of(findings);
  if (options.nodes != 0) {
    std::cout << placement_text(topology::Machine::here(), static_cast<int>(options.nodes), options.reserved_cores);
  }
  std::cout << verdict(findings) << "\n";
  return !in_trouble(findings);
}

launch::Adviser adviser(const std::filesystem::path& self) {
  const auto here = [self](const options::RenderOptions& options, launch::Ask ask) {
    return short_text(check_machine(gather_facts(self, options.nodes, ask)));
  };
  return {[here](const options::RenderOptions& options) { return here(options, launch::Ask::no_programs); },
          [here, self](const options::RenderOptions& options) {
            const auto cluster = look_at_machines(options.hostfile, "", self);
            return cluster ? short_text(all_of(*cluster)) : here(options, launch::Ask::programs);
          },
          [self](const options::RenderOptions& options) {
            const auto cluster = look_at_machines(options.hostfile, "", self);
            return cluster ? advice_about(*cluster) : "";
          }};
}

}  // namespace mars::doctor
