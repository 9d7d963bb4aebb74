#include "host/shell/doctor/facts.h"

#include <stdlib.h>
#include <sys/resource.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <charconv>

#include "hal/failure/failure.h"
#include "hal/messages/settings.h"
#include "host/child/child.h"
#include "host/child/environment.h"
#include "host/child/programs.h"
#include "host/images/display_view.h"
#include "host/window/window_process.h"
#include "topology/machine.h"

namespace mars::doctor {
namespace {

namespace fs = std::filesystem;

// Both outputs of a short program; "" where it cannot be started. What does not answer soon is stopped. Throws Failure
// where a signal to us stops it.
std::string answer(const std::vector<std::string>& words) {
  constexpr std::chrono::seconds kLongest{10};
  std::string text;
  const auto take = [&](const std::string& line) { text += line + "\n"; };
  std::optional<child::Child> child;
  try {
    child.emplace(child::Command{{}, words});
  } catch (const Failure&) {
    return "";
  }
  child::wait_at_most(*child, kLongest, take, take);
  return text;
}

std::string container(const child::Environment& environment) {
  if (const auto name = environment.value("container")) return *name;
  if (environment.value("APPTAINER_NAME") || environment.value("SINGULARITY_NAME")) return "apptainer";
  std::error_code ignored;
  if (fs::exists("/.dockerenv", ignored)) return "docker";
  return fs::exists("/run/.containerenv", ignored) ? "podman" : "";
}

// Lines like "libmpi.so.40 => not found".
std::vector<std::string> lacking_libraries(const fs::path& program) {
  std::vector<std::string> names;
  const std::string text = answer({"/bin/sh", "-c", "ldd \"$0\"", program.string()});
  for (std::size_t at = 0; (at = text.find(" => not found", at)) != std::string::npos; ++at) {
    const std::size_t begin = text.find_last_of("\t\n ", at - 1) + 1;
    names.push_back(text.substr(begin, at - begin));
  }
  return names;
}

std::string simd() {
  if (__builtin_cpu_supports("avx512f")) return "avx512";
  return __builtin_cpu_supports("avx2") ? "avx2" : "sse2";
}

std::optional<Space> space(const fs::path& folder) {
  struct statvfs found = {};
  if (statvfs(folder.c_str(), &found) != 0) return std::nullopt;
  return Space{std::uint64_t{found.f_blocks} * found.f_frsize, std::uint64_t{found.f_bavail} * found.f_frsize};
}

std::optional<Space> writable_space(const std::string& folder) {
  std::string name = folder + "/mars-doctor-XXXXXX";
  const int file = mkstemp(name.data());
  if (file < 0) return std::nullopt;
  close(file);
  unlink(name.c_str());
  return space(folder);
}

std::uint64_t open_files_limit() {
  rlimit limit{};
  return getrlimit(RLIMIT_NOFILE, &limit) == 0 ? limit.rlim_cur : RLIM_INFINITY;
}

std::uint32_t number(const std::optional<std::string>& text, std::uint32_t otherwise) {
  std::uint32_t value = otherwise;
  if (text) std::from_chars(text->data(), text->data() + text->size(), value);
  return value;
}

// `tasks`: of all machines.
std::optional<SlurmJob> slurm_job(const child::Environment& environment, const std::string& path, launch::Ask ask,
                                  std::uint32_t tasks) {
  const auto id = environment.value("SLURM_JOB_ID");
  if (!id) return std::nullopt;
  SlurmJob job{*id,
               number(environment.value("SLURM_NNODES"), 1),
               number(environment.value("SLURM_NTASKS"), tasks),
               environment.value("SLURM_CPUS_PER_TASK").value_or(""),
               environment.value("SRUN_CPUS_PER_TASK").value_or(""),
               false,
               std::nullopt};
  const auto srun = child::find_program("srun", path);
  job.srun = srun.has_value();
  if (srun && ask == launch::Ask::programs) job.plugins = answer({srun->string(), "--mpi=list"});
  return job;
}

}  // namespace

std::string host_name() {
  char name[256] = {};
  gethostname(name, sizeof name - 1);
  return name;
}

Facts gather_facts(const fs::path& self, std::uint32_t nodes, launch::Ask ask) {
  const child::Environment environment = child::own_environment();
  const std::string path = child::program_path(environment);
  const topology::Machine machine = topology::Machine::here();
  Facts facts;
  facts.host = host_name();
  facts.container = container(environment);
  facts.programs = launch::find_programs(self, path);
  facts.surroundings = launch::look_around(path, ask);
  if (facts.programs.mpirun && ask == launch::Ask::programs)
    facts.mpirun_version = answer({facts.programs.mpirun->string(), "--version"});
  if (facts.programs.node && ask == launch::Ask::programs) facts.lacking = lacking_libraries(*facts.programs.node);
  facts.processors = static_cast<std::uint32_t>(machine.processors());
  facts.machine_processors = static_cast<std::uint32_t>(sysconf(_SC_NPROCESSORS_ONLN));
  facts.simd = simd();
  facts.memory = machine.memory();
  facts.limit = topology::memory_limit();
  facts.memory_setting = messages::read_settings().memory;
  facts.open_files = open_files_limit();
  facts.shared = space("/dev/shm");
  facts.temporary = child::temporary_folder(environment);
  facts.temporary_space = writable_space(facts.temporary);
  facts.ffmpeg = child::find_program("ffmpeg", path).has_value();
  const std::optional<fs::path> window = window::find_program(self);
  facts.window = window.has_value();
  if (window && ask == launch::Ask::programs) facts.window_lacking = lacking_libraries(*window);
  facts.view_library = images::view_library_version();
  facts.display = environment.value("DISPLAY").value_or(environment.value("WAYLAND_DISPLAY").value_or(""));
  facts.slurm = slurm_job(environment, path, ask, facts.surroundings.tasks);
  facts.nodes = nodes != 0 ? nodes : facts.processors;
  return facts;
}

}  // namespace mars::doctor
