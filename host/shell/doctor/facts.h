// What is known of the surroundings of a rendering on this machine, as plain values: found out once, and made
// up in tests. What a start itself depends on (programs, root, copies) is found by host/shell/launch, as for mars
// render.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/shell/launch/command.h"
#include "topology/memory_limit.h"

namespace mars::doctor {

struct Space {
  std::uint64_t total = 0;  // bytes
  std::uint64_t left = 0;
};

// Of the job that Slurm gave us, by its environment.
struct SlurmJob {
  std::string id;
  std::uint32_t machines = 1;
  std::uint32_t tasks = 0;    // 0: not said
  std::string cpus_per_task;  // "" where not said; in it Slurm says it, in the other srun reads it
  std::string srun_cpus_per_task;
  bool srun = false;                   // whether it is there
  std::optional<std::string> plugins;  // what srun --mpi=list says; none: it was not asked
};

struct Facts {
  std::string host;
  std::string container;  // "docker", "podman", ...; "" in none
  launch::Programs programs;
  launch::Surroundings surroundings;
  std::optional<std::string> mpirun_version;  // all that mpirun --version says; none: it was not asked
  std::vector<std::string> lacking;           // libraries that mars-node needs and this machine has not
  std::uint32_t processors = 1;               // that this process may use
  std::uint32_t machine_processors = 1;       // that the machine has
  std::string simd;                           // "avx512", "avx2", "sse2"
  std::uint64_t memory = 0;                   // bytes of the machine; 0: unknown
  topology::MemoryLimit limit;
  std::optional<std::uint64_t> memory_setting;   // MARS_MEMORY, bytes
  std::uint64_t open_files = ~std::uint64_t{0};  // that one process may have (ulimit -n)
  std::optional<Space> shared;                   // /dev/shm; none: there is none
  std::string temporary;                         // the folder for temporary files
  std::optional<Space> temporary_space;          // none: we may not write there
  bool ffmpeg = false;
  bool window = false;                      // mars-window is there
  std::vector<std::string> window_lacking;  // libraries that mars-window needs and this machine has not
  std::optional<std::string> view_library;  // the version of OpenColorIO; none: MARS was built without it
  std::string display;                      // that the environment names; "": none
  std::optional<SlurmJob> slurm;
  std::uint32_t nodes = 1;  // of a rendering on this machine
  bool has_others = false;  // the rendering is to use other machines, too
};

std::string host_name();

// `self`: the running program's own file; `nodes`: 0 for one a processor. Throws Failure where a signal stops it.
Facts gather_facts(const std::filesystem::path& self, std::uint32_t nodes, launch::Ask ask);

}  // namespace mars::doctor
