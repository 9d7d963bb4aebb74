#include "host/studio/link/host_job.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
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
#include "host/shell/launch/diagnosis.h"
#include "host/shell/launch/display.h"
#include "host/shell/launch/hostfile.h"
#include "host/shell/launch/job.h"

namespace mars::studio {
namespace {

constexpr int kReason = 3;                               // the job's descriptor for it
constexpr std::chrono::seconds kPatience{20};            // with nodes that do not answer: of no use here
constexpr std::chrono::milliseconds kLongestEnd{2000};   // of a host whose studio has closed the socket
constexpr std::chrono::milliseconds kLongestStop{4000};  // of one that was asked to end

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
  fcntl(kReason, F_SETFD, FD_CLOEXEC);
  closefrom(kReason + 1);
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
  return write(kReason, reason.data(), reason.size()) < 0 ? 1 : 0;
}

child::ProcessSetup setup_of(const child::Descriptor& nothing, const child::Descriptor& reason) {
  return {.streams = {{0, nothing.number()}, {1, nothing.number()}, {kReason, reason.number()}},
          .own_group = true,
          .signal_at_our_end = SIGTERM,
          .default_signals = {SIGINT, SIGTERM, SIGHUP, SIGPIPE}};
}

}  // namespace

HostStart prepare_host(options::RenderOptions options, const std::filesystem::path& self) {
  const std::string path = child::program_path(child::own_environment());
  HostStart start{std::move(options), launch::find_programs(self, path), {}};
  start.options.backend = launch::choose_backend(start.options.backend, start.programs);
  if (start.options.backend == options::Backend::simulated)
    throw Failure("simulated nodes draw no pictures of a studio", "", "use --backend mpi or threads");
  start.surroundings = launch::look_around(path);
  if (!start.options.hostfile.empty() && start.options.backend == options::Backend::mpi)
    start.surroundings.machines = machines_from_here(launch::read_hostfile(start.options.hostfile), this_machine());
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

HostJob::HostJob(const child::Command& command, const options::RenderOptions& options)
    : reason_(child::make_pipe()),
      process_([&] { return watch_job(command, options); }, setup_of(child::null_device(), reason_.writing)) {
  reason_.writing.close();
}

HostJob::~HostJob() {
  const auto ends_within = [&](std::chrono::milliseconds longest) {
    const auto last = std::chrono::steady_clock::now() + longest;
    while (!process_.poll()) {
      if (std::chrono::steady_clock::now() >= last) return false;
      ::poll(nullptr, 0, 2);
    }
    return true;
  };
  if (ends_within(kLongestEnd)) return;
  process_.send(SIGTERM);
  if (!ends_within(kLongestStop)) process_.give_up();  // it kills what does not end, and takes its time for it
}

}  // namespace mars::studio
