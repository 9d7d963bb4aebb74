#include "host/studio/link/host_job.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <string_view>
#include <utility>

#include "hal/failure/explain.h"
#include "hal/failure/failure.h"
#include "host/child/environment.h"
#include "host/child/standard_streams.h"
#include "host/shell/launch/asked_machines.h"
#include "host/shell/launch/diagnosis.h"
#include "host/shell/launch/display.h"
#include "host/shell/launch/job.h"

namespace mars::studio {
namespace {

constexpr std::chrono::seconds kPatience{20};  // with nodes that do not answer: of no use here

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

std::string this_machine() {
  char name[256] = {};
  gethostname(name, sizeof name - 1);
  return name;
}

// Without a domain.
std::string_view short_name(std::string_view machine) { return machine.substr(0, machine.find('.')); }

// The slots of the machines less one for the host, as for a rendering.
std::uint32_t default_nodes(const HostStart& start) {
  std::uint32_t slots = 0;
  for (const launch::Slots& machine : start.surroundings.machines) slots += machine.count;
  return slots > 0 ? std::max(slots, 2u) - 1 : launch::default_nodes(start.options, start.surroundings);
}

// In the job's process, which has the studio's memory but none of its files.
int watch_job(const child::Command& command, const options::RenderOptions& options) {
  closefrom(STDERR_FILENO + 1);
  std::string reason;
  try {
    launch::Display nothing(launch::Display::Kind::silent, child::raw_output());
    launch::Job job(nothing);
    job.follow(command, {kPatience, [](child::Child&) {}, [] {}});
    if (!job.remains().well()) reason = launch::diagnose(job.remains(), options, {}).failure.what();
  } catch (const std::exception& failure) {
    reason = reason_of(failure);
  }
  reason = first_line(reason);
  if (reason.empty()) return 0;
  return write(STDERR_FILENO, reason.data(), reason.size()) < 0 ? 2 : 1;
}

}  // namespace

HostStart prepare_host(options::RenderOptions options, const std::filesystem::path& self) {
  const child::Environment environment = child::own_environment();
  const std::string path = child::program_path(environment);
  HostStart start{std::move(options), launch::find_programs(self, path), {}};
  start.options.backend = launch::choose_backend(start.options, start.programs, environment);
  if (start.options.backend == options::Backend::simulated)
    throw Failure("simulated nodes draw no pictures of a studio", "", "use --backend mpi or threads");
  start.surroundings = launch::look_around(path);
  std::vector<launch::Slots> named;
  if (start.options.backend == options::Backend::mpi)
    named = launch::named_machines(start.options.hostfile, environment);
  if (!named.empty()) start.surroundings.machines = machines_from_here(std::move(named), this_machine());
  if (start.options.nodes == 0) start.options.nodes = default_nodes(start);
  options::check_nodes(start.options, launch::cores_in_use(start.options, start.surroundings));
  return start;
}

std::vector<launch::Slots> machines_from_here(std::vector<launch::Slots> machines, const std::string& here) {
  const auto is_here = [&](const launch::Slots& machine) {
    return machine.host == "localhost" || short_name(machine.host) == short_name(here);
  };
  const auto found = std::ranges::find_if(machines, is_here);
  if (found == machines.end())
    machines.insert(machines.begin(), {here, 1});
  else
    std::rotate(machines.begin(), found, found + 1);
  return machines;
}

child::Command host_command(const HostStart& start, const std::string& socket) {
  options::RenderOptions options = start.options;
  options.film.clear();
  options.serve = socket;
  if (options.backend == options::Backend::threads) return launch::threads_command(options, start.programs);
  return launch::mpi_command(options, start.programs, start.surroundings);
}

std::unique_ptr<child::Process> start_host_job(const child::Command& command, const options::RenderOptions& options,
                                               const child::ProcessSetup& setup) {
  return std::make_unique<child::Process>([&] { return watch_job(command, options); }, setup);
}

}  // namespace mars::studio
