// The commands that start jobs, made for each backend from a person's options and from what the machine has.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hal/failure/failure.h"
#include "host/child/command.h"
#include "host/child/environment.h"
#include "host/shell/launch/slots.h"
#include "host/shell/options/render_options.h"

namespace mars::launch {

// A command as it can be pasted into a shell.
std::string shell_text(const child::Command& command);

// Whose mpirun starts the programs. Intel's and others that come from MPICH are as MPICH is.
enum class Mpi { open_mpi, mpich };

// The MPI that MARS was built with.
Mpi our_mpi();
const char* name_of(Mpi mpi);
const char* package_of(Mpi mpi);  // Debian's, with its mpirun
const char* module_of(Mpi mpi);   // as clusters usually name it

// Where the programs are that `mars render` starts; none: not installed.
struct Programs {
  std::optional<std::filesystem::path> mpirun;
  std::optional<std::filesystem::path> host;
  std::optional<std::filesystem::path> node;
  std::optional<std::filesystem::path> threads;
  std::optional<std::filesystem::path> simulated;
  Mpi mpi = our_mpi();
  std::optional<std::filesystem::path> loopback;    // loopback.cpp, for mpirun to load
  std::optional<std::filesystem::path> messages{};  // mars-messages
};

// The first mpirun in `path`; a folder that has those of several MPIs distinguishes them by their names.
std::optional<std::filesystem::path> find_mpirun(Mpi mpi, const std::string& path);

// `asked`: the machines that the run was asked to use, as of asked_machines(); `without`: what a person may do instead.
Failure no_mpirun(Mpi mpi, const std::string& asked, const std::string& without);

// Beside `self`, or in ../libexec/mars or ../libexec/mars-nx from there.
std::optional<std::filesystem::path> find_loopback(const std::filesystem::path& self);

// Looks for our own beside `self`, then in ../libexec from there, then in `path`.
Programs find_programs(const std::filesystem::path& self, const std::string& path);

// What a start depends on.
struct Surroundings {
  std::uint32_t cores = 1;  // of the processors this process was given
  std::uint32_t processors = 1;
  std::uint32_t tasks = 0;  // that the batch system lets this job run on all its hosts; 0: there is none
  bool root = false;
  bool copies_forbidden = false;       // processes may not read each other's memory, as in some containers
  bool no_remote_shell = false;        // neither ssh nor rsh is in the PATH
  std::vector<std::string> settings;   // MARS_* variables that are set, for nodes on other machines
  std::uint64_t address_limit = 0;     // bytes of addresses that a process may have: ulimit -v; 0: no limit
  child::Environment environment{{}};  // what it sets of MPI's settings counts
  std::vector<Slots> machines{};       // to use, the host's first; none: those of the hostfile or the batch system
};

// Whether programs and processes are started to find facts: none may be while a job is waited for (Child).
enum class Ask { programs, no_programs };

// `path` as for find_programs. Whether copies are forbidden is found by a process: false without.
Surroundings look_around(const std::string& path, Ask ask = Ask::programs);

// Slurm's list of tasks a host, "2(x3),1", as 2 2 2 1; none for what is none.
std::vector<std::uint32_t> tasks_of_machines(const std::string& tasks_per_node);

// How many nodes render where a person does not say: the slots of the hostfile or the batch system beside
// the host; else, and for threads, one a processor.
std::uint32_t default_nodes(const options::RenderOptions& options, const Surroundings& surroundings);

// Of the machines that a rendering uses: other machines' slots stand for theirs. `options.backend` is settled.
std::uint32_t cores_in_use(const options::RenderOptions& options, const Surroundings& surroundings);

// Takes auto to one of the two: never to threads of this machine alone where a run was asked to use others
// (asked_machines.h). Throws Failure where the programs for the backend are missing.
options::Backend choose_backend(const options::RenderOptions& options, const Programs& programs,
                                const child::Environment& environment);

// mpirun as it begins wherever it starts options.nodes nodes and a host: the words before the programs'. Throws Failure
// where the memory limit is too small for any MPI, and as named_machines() does.
child::Command mpi_start(const options::RenderOptions& options, const Programs& programs,
                         const Surroundings& surroundings);

// One of mpirun's programs, with the settings for those of its processes that are on other machines: Open MPI hands
// them on to the program that follows alone. Between two programs stands ":".
void add_program(child::Command& command, std::uint32_t count, const std::filesystem::path& program,
                 const Programs& programs, const Surroundings& surroundings);

// mpirun with one host and options.nodes nodes; one process of as many threads. `options.nodes` is settled.
child::Command mpi_command(const options::RenderOptions& options, const Programs& programs,
                           const Surroundings& surroundings);
child::Command simulated_command(const options::RenderOptions& options, const Programs& programs);
child::Command threads_command(const options::RenderOptions& options, const Programs& programs);

}  // namespace mars::launch
