#include "host/shell/doctor/checks.h"

#include <algorithm>
#include <cctype>

#include "host/content/document/text.h"
#include "host/render/farm/node_memory.h"
#include "host/shell/launch/asked_machines.h"
#include "host/shell/launch/text_reader.h"

namespace mars::doctor {
namespace {

using State = Finding::State;

constexpr std::uint64_t kMiB = 1024 * 1024;
constexpr std::uint64_t kLittleMemory = 256 * kMiB;  // for a node's frames
constexpr std::uint64_t kLeastShared = 16 * kMiB;
constexpr std::uint64_t kSharedByANode = 4 * kMiB;     // Open MPI's segment for messages
constexpr std::uint64_t kLittleTemporary = 16 * kMiB;  // free

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

bool has(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

bool several_machines(const Facts& facts) { return facts.has_others || (facts.slurm && facts.slurm->machines > 1); }

// "5.0.3", with its first number; "" where an mpirun that prints this is another MPI's.
std::string version_of(launch::Mpi mpi, const std::string& printed) {
  const auto behind = [&](std::initializer_list<const char*> words) -> std::string {
    launch::TextReader reader(printed);
    for (const char* each : words)
      if (!reader.find(each)) return "";
    reader.skip_space();
    const std::string version = reader.word().value_or("");
    return !version.empty() && std::isdigit(static_cast<unsigned char>(version.front())) ? version : "";
  };
  if (mpi == launch::Mpi::mpich) return behind({"HYDRA", "Version:"});
  for (const char* name : {"(Open MPI)", "(Open RTE)", "(OpenRTE)", "(PRRTE)"})
    if (const std::string version = behind({name}); !version.empty()) return version;
  return "";
}

Finding check_mpi(const Facts& facts) {
  const char* about = "MPI";
  const launch::Mpi mpi = facts.programs.mpi;
  const std::string name = launch::name_of(mpi);
  const std::string load = "(module load " + std::string(launch::module_of(mpi)) + ")";
  if (!facts.programs.mpirun) {
    const std::string asked = launch::asked_machines("", facts.surroundings.environment);
    const Failure missing = launch::no_mpirun(mpi, asked, "");
    if (!asked.empty() || several_machines(facts) || !facts.programs.threads)
      return {State::trouble, about, missing.problem, missing.remedy};
    return {State::note, about, missing.problem + ": nodes are threads of one process",
            "for several machines " + missing.remedy};
  }
  const std::string where = ", " + facts.programs.mpirun->string();
  if (!facts.mpirun_version) return {State::good, about, name + where, ""};
  if (facts.mpirun_version->empty()) {
    return {State::trouble, about, "mpirun --version says nothing" + where,
            "mpirun --version must work: load MPI again, or use --backend threads"};
  }
  const std::string version = version_of(mpi, *facts.mpirun_version);
  if (version.empty()) {
    return {State::trouble, about, "mpirun is not " + name + "'s: " + first_line(*facts.mpirun_version) + where,
            "put " + name + "'s mpirun first in the PATH " + load + ", or use --backend threads"};
  }
  if (version.starts_with("4.")) return {State::good, about, name + " " + version + where, ""};
  return {State::note, about, name + " " + version + where,
          "MARS is tried with Open MPI 4.1 and MPICH 4.0: see below whether a start works"};
}

Finding check_programs(const Facts& facts) {
  const char* about = "programs";
  const launch::Programs& programs = facts.programs;
  std::vector<std::string> lacking;
  for (const auto& [name, there] :
       {std::pair{"mars-host", programs.host.has_value()}, std::pair{"mars-node", programs.node.has_value()},
        std::pair{"mars-threads", programs.threads.has_value()}}) {
    if (!there) lacking.emplace_back(name);
  }
  if (!lacking.empty()) {
    const bool needed = programs.mpirun || !programs.threads;
    return {needed ? State::trouble : State::note, about,
            "not beside mars or in the PATH: " + document::joined(lacking),
            "build MARS where MPI is installed, and keep its programs in one folder"};
  }
  if (!facts.lacking.empty()) {
    return {State::trouble, about, "mars-node lacks libraries: " + document::joined(facts.lacking),
            "load the MPI that MARS was built with (module load ...), or install it on this machine"};
  }
  const auto folder = programs.node->parent_path();
  if (programs.host->parent_path() != folder || programs.threads->parent_path() != folder) {
    return {State::note, about, programs.host->string() + ", but " + programs.node->string(),
            "keep MARS's programs in one folder: of different versions they do not understand each other"};
  }
  return {State::good, about, "mars-host, mars-node, mars-threads in " + folder.string(), ""};
}

Finding check_processors(const Facts& facts) {
  const std::uint32_t cores = facts.surroundings.cores;
  std::string found = document::counted(cores, "core");
  if (facts.processors != cores) found += ", " + document::counted(facts.processors, "hardware thread");
  found += ", " + facts.simd;
  if (facts.processors < facts.machine_processors) {
    return {facts.slurm ? State::good : State::note, "processors",
            found + "; the machine has " + std::to_string(facts.machine_processors) + " processors",
            facts.slurm ? ""
                        : "MARS uses what it is given: see taskset -p $$, or the container's --cpuset-cpus and --cpus"};
  }
  if (facts.simd == "sse2") return {State::note, "processors", found + " only: renders, but slower than with AVX2", ""};
  return {State::good, "processors", found, ""};
}

Finding check_nodes(const Facts& facts) {
  const char* about = "slots";
  const std::uint32_t cores = facts.surroundings.cores;
  if (facts.slurm && facts.slurm->tasks != 0 && !several_machines(facts) && facts.slurm->tasks < facts.nodes + 1) {
    return {State::note, about,
            "the job has " + document::counted(facts.slurm->tasks, "task") + ", the host and " +
                document::counted(facts.nodes, "node") + " want " + std::to_string(facts.nodes + 1),
            "ask for one task more than nodes (sbatch -n " + std::to_string(facts.nodes + 1) + "), or use --nodes " +
                std::to_string(std::max(1u, facts.slurm->tasks - 1))};
  }
  if (facts.nodes > cores) {
    return {State::note, about,
            document::counted(facts.nodes, "node") + " on " + document::counted(cores, "core") +
                ": they take turns, bound to none",
            "--nodes " + std::to_string(cores) + " gives each a core of its own"};
  }
  return {State::good, about,
          document::counted(facts.nodes, "node") + " on " + document::counted(cores, "core") +
              ": each bound to its own",
          ""};
}

// The largest picture of 16 x 9 of which a node that is alone keeps all still parts, whatever they show: "1920x1080".
std::string kept_picture(std::uint64_t share, std::uint32_t samples) {
  wire::FilmSettings film{};
  film.samples = samples;
  const auto is_kept = [&](std::uint32_t times) {
    film.width = 16 * times;
    film.height = 9 * times;
    const wire::StillPlan plan = farm::share_node_memory(share, {}, film).still_plan;
    return plan.lines == film.height && plan.groups_per_column == samples;
  };
  std::uint32_t times = 0;
  while (16 * (times + 1) <= wire::kMaxSide && is_kept(times + 1)) ++times;
  return std::to_string(16 * times) + "x" + std::to_string(9 * times);
}

Finding check_memory(const Facts& facts) {
  const char* about = "memory";
  std::string found = facts.memory != 0 ? bytes_text(facts.memory) : "of unknown size";
  if (facts.limit.together != 0 && (facts.memory == 0 || facts.limit.together < facts.memory))
    found += ", " + bytes_text(facts.limit.together) + " of it for this job (cgroup)";
  const auto [addresses, data] = facts.limit.each;
  if (addresses != 0) found += ", " + bytes_text(addresses) + " of addresses a process (ulimit -v)";
  if (data != 0) found += ", " + bytes_text(data) + " a process (ulimit -d)";
  const std::uint64_t share =
      facts.memory_setting.value_or(topology::memory_share(facts.memory, facts.limit, static_cast<int>(facts.nodes)));
  found += "; for a node's frames " + bytes_text(share) + (facts.memory_setting ? " (MARS_MEMORY)" : "");
  found += "; stationary parts are kept up to " + kept_picture(share, 4) + " at 4 samples, " + kept_picture(share, 16) +
           " at 16";
  if (share >= kLittleMemory) return {State::good, about, found, ""};
  return {State::note, about, found,
          "if frames take several passes (--report): fewer --nodes, or more memory (sbatch --mem, "
          "docker run --memory)"};
}

Finding check_shared(const Facts& facts) {
  const char* about = "/dev/shm";
  const char* remedy = "enlarge it: mount -o remount,size=1G /dev/shm, or start the container with --shm-size=1g";
  if (!facts.shared) return {State::trouble, about, "is not there", "mount a tmpfs at /dev/shm"};
  const Space& space = *facts.shared;
  const std::string found = bytes_text(space.total) + ", " + bytes_text(space.left) + " free";
  if (space.left < kLeastShared)
    return {State::trouble, about, found, std::string(remedy) + "; files of ended jobs there may be deleted"};
  if (space.left < (facts.nodes + 1) * kSharedByANode)
    return {State::note, about, found + ": too little for the messages of so many nodes", remedy};
  return {State::good, about, found, ""};
}

// Open MPI's mpirun waits for ever where it lacks files. What it needs was measured with 4.1: 36, 40, 64 and 96 for 1,
// 2, 8 and 16 nodes on one machine.
Finding check_open_files(const Facts& facts) {
  const std::uint64_t needed = 40 + 4 * std::uint64_t{facts.nodes};
  if (facts.open_files >= needed)
    return {State::good, "open files", "enough for " + document::counted(facts.nodes, "node"), ""};
  return {State::trouble, "open files",
          "a process may have " + std::to_string(facts.open_files) + ", mpirun needs about " + std::to_string(needed) +
              " for " + document::counted(facts.nodes, "node"),
          "ulimit -n " + std::to_string(std::max<std::uint64_t>(1024, needed))};
}

Finding check_copies(const Facts& facts) {
  if (!facts.surroundings.copies_forbidden)
    return {State::good, "copies", "processes may copy from each other's memory (CMA)", ""};
  return {State::note, "copies", "processes may not copy from each other's memory (CMA): slower messages",
          "mars render sets it; for mpirun by hand export OMPI_MCA_btl_vader_single_copy_mechanism=none. "
          "Containers allow it with --cap-add=SYS_PTRACE, kernels with sysctl kernel.yama.ptrace_scope=0"};
}

Finding check_user(const Facts& facts) {
  const std::string place = facts.container.empty() ? "" : " in a container (" + facts.container + ")";
  if (!facts.surroundings.root) return {State::good, "user", "not root" + place, ""};
  if (facts.programs.mpi == launch::Mpi::mpich) return {State::good, "user", "root" + place, ""};
  return {State::note, "user", "root" + place + ": Open MPI starts as root only with two settings",
          "mars render sets them; for mpirun by hand export OMPI_ALLOW_RUN_AS_ROOT=1 "
          "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1"};
}

Finding check_temporary(const Facts& facts) {
  const char* about = "TMPDIR";
  if (!facts.temporary_space) {
    return {State::trouble, about, facts.temporary + " cannot be written",
            "MPI needs it: set TMPDIR to a folder on a local disk that you may write"};
  }
  const std::string found = facts.temporary + ", " + bytes_text(facts.temporary_space->left) + " free";
  if (facts.temporary_space->left < kLittleTemporary)
    return {State::trouble, about, found, "empty it, or set TMPDIR to a folder on a local disk with free space"};
  return {State::good, about, found, ""};
}

Finding check_video(const Facts& facts) {
  if (facts.ffmpeg) return {State::good, "ffmpeg", "is there, to make videos", ""};
  return {State::note, "ffmpeg", "was not found: frames can be rendered, but no videos", "install it (Debian: ffmpeg)"};
}

Finding check_views(const Facts& facts) {
  if (facts.view_library) return {State::good, "OpenColorIO", *facts.view_library + ", for --ocio", ""};
  return {State::note, "OpenColorIO", "MARS was built without it: --ocio is refused",
          "build MARS with OpenColorIO 2.1 or newer (Debian: libopencolorio-dev)"};
}

Finding check_window(const Facts& facts) {
  if (!facts.window)
    return {State::note, "window", "mars-window was not found: mars render --window shows nothing",
            "install the package mars-window, or build MARS with SDL 2 (Debian: libsdl2-dev)"};
  if (!facts.window_lacking.empty())
    return {State::note, "window", "mars-window lacks " + document::joined(facts.window_lacking),
            "install it (Debian: libsdl2-2.0-0)"};
  if (facts.display.empty())
    return {State::good, "window", "mars-window is there, but no display (DISPLAY is not set)", ""};
  return {State::good, "window", "mars-window is there, and the display " + facts.display, ""};
}

void check_slurm(const Facts& facts, std::vector<Finding>& findings) {
  const SlurmJob& job = *facts.slurm;
  const std::string found = "job " + job.id + ", " + document::counted(job.machines, "machine") +
                            (job.tasks != 0 ? ", " + document::counted(job.tasks, "task") : "");
  findings.push_back({State::good, "Slurm", found, ""});
  if (!job.srun) {
    const bool stuck = several_machines(facts) && facts.surroundings.no_remote_shell;
    findings.push_back({stuck ? State::trouble : State::note, "srun", "was not found",
                        "have Slurm's client programs on this machine, or start from one that has"});
  } else if (job.plugins && !has(*job.plugins, "pmix")) {
    findings.push_back({State::note, "srun", "has no plugin pmix: srun cannot start Open MPI's programs",
                        "start by mars render or mpirun, or install the plugin (Debian: slurm-wlm-basic-plugins)"});
  }
  if (!job.cpus_per_task.empty() && job.srun_cpus_per_task != job.cpus_per_task) {
    findings.push_back({State::note, "srun", "does not take over --cpus-per-task of the job",
                        "in a job script: export SRUN_CPUS_PER_TASK=$SLURM_CPUS_PER_TASK"});
  }
}

}  // namespace

std::string bytes_text(std::uint64_t bytes) {
  const double mebibytes = static_cast<double>(bytes) / kMiB;
  if (bytes >= 10 * 1024 * kMiB) return document::formatted("%.0f GiB", mebibytes / 1024);
  if (bytes >= 1024 * kMiB) return document::formatted("%.1f GiB", mebibytes / 1024);
  return document::formatted("%.0f MiB", mebibytes);
}

std::vector<Finding> check_machine(const Facts& facts) {
  std::vector<Finding> findings{check_mpi(facts)};
  for (const auto check : {check_programs, check_processors, check_nodes, check_memory, check_open_files, check_shared,
                           check_copies, check_user, check_temporary}) {
    findings.push_back(check(facts));
  }
  if (facts.slurm) check_slurm(facts, findings);
  if (facts.programs.mpirun && !facts.slurm && facts.surroundings.no_remote_shell) {
    findings.push_back({State::note, "ssh", "was not found: MPI can start on this machine only",
                        "for other machines install ssh (Debian: openssh-client)"});
  }
  findings.push_back(check_video(facts));
  findings.push_back(check_views(facts));
  findings.push_back(check_window(facts));
  return findings;
}

Finding check_start(const launch::Trial& trial) {
  if (trial.failure) {
    const Failure& failure = *trial.failure;
    const std::string found = failure.where.empty() ? failure.problem : failure.where + ": " + failure.problem;
    return {State::trouble, "a start", found, failure.remedy + (failure.remedy.empty() ? "" : "\n") + trial.command};
  }
  const events::Booted& booted = trial.booted;
  return {State::good, "a start",
          document::counted(booted.nodes.size(), "node") + " on " + document::counted(booted.machines, "machine") +
              " (" + booted.backend + ") booted in " + document::formatted("%.1f", trial.boot_seconds) +
              " s, rendered " + document::counted(trial.frames, "frame"),
          ""};
}

}  // namespace mars::doctor
