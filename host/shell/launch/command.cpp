#include "host/shell/launch/command.h"

#include <signal.h>
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <string_view>
#include <system_error>

#include "hal/failure/process_limit.h"
#include "hal/messages/settings.h"
#include "host/child/environment.h"
#include "host/child/process.h"
#include "host/child/programs.h"
#include "host/content/document/shell_word.h"
#include "host/shell/launch/asked_machines.h"
#include "host/shell/launch/hostfile.h"
#include "host/shell/launch/text_reader.h"
#include "topology/machine.h"

namespace mars::launch {

namespace fs = std::filesystem;

namespace {

constexpr std::uint32_t kMostMachines = 1 << 20;
constexpr const char* kLoopback = "mars-loopback.so";

std::optional<fs::path> find_ours(const std::string& name, const fs::path& self, const std::string& path) {
  for (const fs::path& folder : {self.parent_path(), self.parent_path().parent_path() / "libexec"}) {
    if (child::runnable(folder / name)) return folder / name;
  }
  return child::find_program(name, path);
}

// Open MPI's large messages within a machine are copied by the receiver straight from the sender's memory,
// which some containers and kernels forbid; it then complains, or fails. Whether they do shows on a process
// of ours.
bool may_copy() {
  int from = 1;
  int to = 0;
  const auto sleep = []() -> int {
    for (;;) pause();
  };
  const child::Process other(sleep, {.signal_at_our_end = SIGKILL});
  const iovec local{&to, sizeof to};
  const iovec remote{&from, sizeof from};
  return process_vm_readv(other.id(), &local, 1, &remote, 1, 0) == sizeof from;
}

std::vector<std::string> settings_in_use() {
  std::vector<std::string> names;
  for (const messages::Setting& setting : messages::settings_table()) {
    if (child::own_environment().value(setting.name)) names.emplace_back(setting.name);
  }
  return names;
}

using Variables = std::vector<std::pair<std::string, std::string>>;

// Those that a person did not set.
void add_settings(child::Command& command, const Variables& settings, const Surroundings& surroundings) {
  for (const auto& setting : settings)
    if (!surroundings.environment.value(setting.first)) command.environment.push_back(setting);
}

// Open MPI notices a host that is gone, without a word, by its silence: left alone after eight minutes.
const Variables kKeepalive = {{"OMPI_MCA_oob_tcp_keepalive_time", "10"},
                              {"OMPI_MCA_oob_tcp_keepalive_intvl", "5"},
                              {"OMPI_MCA_oob_tcp_keepalive_probes", "3"}};

// Programs that ssh starts have an environment of their own. Open MPI writes the folders into a shell's line as they
// are.
void add_libraries(child::Command& command, const Surroundings& surroundings) {
  const std::string folders = surroundings.environment.value("LD_LIBRARY_PATH").value_or("");
  if (!folders.empty() && document::shell_word(folders) == folders)
    add_settings(command, {{"OMPI_MCA_plm_rsh_pass_libpath", folders}}, surroundings);
}

// These make mpirun look for other machines, beside a hostfile of ours and batch systems.
constexpr std::array kOtherMachines = {"OMPI_MCA_orte_default_hostfile", "HYDRA_HOST_FILE"};

bool on_this_machine_alone(const options::RenderOptions& options, const Surroundings& surroundings) {
  return options.hostfile.empty() && surroundings.tasks == 0 && !batch_lists_machines(surroundings.environment) &&
         std::none_of(kOtherMachines.begin(), kOtherMachines.end(),
                      [&](const char* name) { return surroundings.environment.value(name).has_value(); });
}

// Nobody outside of this machine can connect to the job. The loader separates names by blanks and colons.
void add_loopback(child::Command& command, const Programs& programs, const Surroundings& surroundings) {
  if (!programs.loopback || programs.loopback->string().find_first_of(" :") != std::string::npos) return;
  const auto others = surroundings.environment.value("LD_PRELOAD");
  command.environment.emplace_back("LD_PRELOAD", programs.loopback->string() + (others ? ":" + *others : ""));
}

}  // namespace

Mpi our_mpi() { return MARS_MPICH ? Mpi::mpich : Mpi::open_mpi; }

const char* name_of(Mpi mpi) { return mpi == Mpi::mpich ? "MPICH" : "Open MPI"; }
const char* package_of(Mpi mpi) { return mpi == Mpi::mpich ? "mpich" : "openmpi-bin"; }
const char* module_of(Mpi mpi) { return mpi == Mpi::mpich ? "mpich" : "openmpi"; }

std::optional<fs::path> find_mpirun(Mpi mpi, const std::string& path) {
  static constexpr std::string_view kOpenMpi[] = {"mpirun.openmpi", "mpirun"};
  static constexpr std::string_view kMpich[] = {"mpirun.mpich", "mpiexec.hydra", "mpirun"};
  return mpi == Mpi::mpich ? child::find_first_program(kMpich, path) : child::find_first_program(kOpenMpi, path);
}

Failure no_mpirun(Mpi mpi, const std::string& asked, const std::string& without) {
  return Failure("mpirun was not found" + (asked.empty() ? "" : ", and " + asked), "",
                 "load the module of " + std::string(name_of(mpi)) + ", for example module load " + module_of(mpi) +
                     ", or install it (Debian: " + package_of(mpi) + ")" + without);
}

std::optional<fs::path> find_loopback(const fs::path& self) {
  const fs::path beside = self.parent_path();
  const fs::path libexec = beside.parent_path() / "libexec";
  std::error_code ignored;
  for (const fs::path& folder : {beside, libexec / "mars", libexec / "mars-nx"})
    if (fs::is_regular_file(folder / kLoopback, ignored)) return folder / kLoopback;
  return std::nullopt;
}

std::string shell_text(const child::Command& command) {
  std::string text;
  for (const auto& [name, value] : command.environment) text += name + "=" + document::shell_word(value) + " ";
  for (const std::string& word : command.words) text += document::shell_word(word) + " ";
  text.pop_back();
  return text;
}

Programs find_programs(const fs::path& self, const std::string& path) {
  return {find_mpirun(our_mpi(), path),
          find_ours("mars-host", self, path),
          find_ours("mars-node", self, path),
          find_ours("mars-threads", self, path),
          find_ours("mars-simulated", self, path),
          our_mpi(),
          find_loopback(self),
          find_ours("mars-messages", self, path)};
}

Surroundings look_around(const std::string& path, Ask ask) {
  const bool remote_shell = child::find_program("ssh", path) || child::find_program("rsh", path);
  const topology::Machine machine = topology::Machine::here();
  const auto tasks = tasks_of_machines(child::own_environment().value("SLURM_TASKS_PER_NODE").value_or(""));
  return {static_cast<std::uint32_t>(machine.cores()),
          static_cast<std::uint32_t>(machine.processors()),
          std::accumulate(tasks.begin(), tasks.end(), 0u),
          geteuid() == 0,
          ask == Ask::programs && !may_copy(),
          !remote_shell,
          settings_in_use(),
          process_limit().addresses,
          child::own_environment()};
}

std::vector<std::uint32_t> tasks_of_machines(const std::string& tasks_per_node) {
  std::vector<std::uint32_t> tasks;
  TextReader words(tasks_per_node);
  do {
    const std::uint32_t each = words.number().value_or(0);
    const std::uint32_t machines = words.skip("(x") ? words.number().value_or(0) : 1;
    if (each > 0) tasks.insert(tasks.end(), std::min(machines, kMostMachines), each);
    words.skip(")");
  } while (words.skip(","));
  return tasks;
}

namespace {

// Of the hostfile or the batch system; 0: there is none.
std::uint32_t slots_of(const options::RenderOptions& options, const Surroundings& surroundings) {
  const std::vector<Slots> machines = named_machines(options.hostfile, surroundings.environment);
  if (machines.empty()) return surroundings.tasks;
  return std::accumulate(machines.begin(), machines.end(), 0u,
                         [](std::uint32_t sum, const Slots& slots) { return sum + slots.count; });
}

}  // namespace

std::uint32_t default_nodes(const options::RenderOptions& options, const Surroundings& surroundings) {
  if (options.backend == options::Backend::threads || options.backend == options::Backend::simulated)
    return surroundings.processors;
  const std::uint32_t tasks = slots_of(options, surroundings);
  return tasks == 0 ? surroundings.processors : std::max(tasks, 2u) - 1;
}

std::uint32_t cores_in_use(const options::RenderOptions& options, const Surroundings& surroundings) {
  if (options.backend != options::Backend::mpi) return surroundings.cores;
  if (slots_of(options, surroundings) == 0) return surroundings.cores;
  std::uint32_t cores = 0;
  for (const Slots& machine : named_machines(options.hostfile, surroundings.environment))
    cores += is_here(machine.host) ? surroundings.cores : machine.count;
  return cores != 0 ? cores : surroundings.tasks;
}

options::Backend choose_backend(const options::RenderOptions& options, const Programs& programs,
                                const child::Environment& environment) {
  const bool mpi = programs.mpirun && programs.host && programs.node;
  const bool automatic = options.backend == options::Backend::automatic;
  const std::string asked = automatic && !mpi ? asked_machines(options.hostfile, environment) : "";
  const options::Backend backend = !automatic              ? options.backend
                                   : mpi || !asked.empty() ? options::Backend::mpi
                                                           : options::Backend::threads;
  if (backend == options::Backend::mpi && !programs.mpirun) {
    const std::string threads = ", or use --backend threads on this machine alone";
    throw no_mpirun(programs.mpi, asked, options.hostfile.empty() ? threads : "");
  }
  if (backend == options::Backend::mpi && !mpi) {
    throw Failure("mars-host and mars-node were not found beside mars or in the PATH", "",
                  "build MARS where MPI is installed, or use --backend threads");
  }
  if (backend == options::Backend::threads && !programs.threads) {
    throw Failure("mars-threads was not found beside mars or in the PATH", "", "build or install MARS whole");
  }
  if (backend == options::Backend::simulated && !programs.simulated) {
    throw Failure("mars-simulated was not found beside mars or in the PATH", "", "build or install MARS whole");
  }
  return backend;
}

namespace {

// Open MPI's processes need some 200 MB of addresses before they begin; with less they end in many ways, or hang.
constexpr std::uint64_t kLeastForMpi = std::uint64_t{400} << 20;

// "n1:4,n2:4"
std::string host_list(const std::vector<Slots>& machines) {
  std::string hosts;
  for (const Slots& slots : machines)
    hosts += (hosts.empty() ? "" : ",") + slots.host + ":" + std::to_string(slots.count);
  return hosts;
}

// Takes over the environment, goes round over the hosts by itself, and finds a batch system's hosts.
child::Command mpich_start(const options::RenderOptions& options, const Programs& programs,
                           const Surroundings& surroundings) {
  child::Command command{{}, {programs.mpirun->string(), "-bind-to", "none"}};
  if (on_this_machine_alone(options, surroundings)) {
    add_settings(command, {{"UCX_TLS", "sm,self"}}, surroundings);
    add_loopback(command, programs, surroundings);
  }
  if (!surroundings.machines.empty())
    command.words.insert(command.words.end(), {"-hosts", host_list(surroundings.machines)});
  else if (!options.hostfile.empty())
    command.words.insert(command.words.end(), {"-hosts", host_list(read_hostfile(options.hostfile))});
  return command;
}

child::Command open_mpi_start(const options::RenderOptions& options, const Programs& programs,
                              const Surroundings& surroundings) {
  child::Command command;
  const auto add = [&](const Variables& settings) { add_settings(command, settings, surroundings); };
  // As root Open MPI starts as root only with two settings; as the only user of a container there is nobody else to be.
  if (surroundings.root) {
    command.environment = {{"OMPI_ALLOW_RUN_AS_ROOT", "1"}, {"OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1"}};
  }
  if (surroundings.copies_forbidden) add({{"OMPI_MCA_btl_vader_single_copy_mechanism", "none"}});
  // It looks for one even where all ranks are on this machine, and gives up without.
  if (surroundings.no_remote_shell) add({{"OMPI_MCA_plm", "^rsh"}});
  if (on_this_machine_alone(options, surroundings)) {
    // Its other ways of keeping start-up data warn where several jobs or users share a machine. Over several
    // machines this one hangs when it starts two programs from outside of the allocation.
    add({{"PMIX_MCA_gds", "hash"}});
    // Ranks open no sockets; and no machines that an administrator named by default.
    add({{"OMPI_MCA_pml", "ob1"}, {"OMPI_MCA_btl", "self,vader"}, {"OMPI_MCA_orte_default_hostfile", "none"}});
    add_loopback(command, programs, surroundings);
    command.open_mpi = child::OpenMpi::on_this_machine;
  } else {
    add(kKeepalive);
    add_libraries(command, surroundings);
    command.open_mpi = child::OpenMpi::on_several;
  }
  command.words = {programs.mpirun->string(), "--bind-to", "none"};
  const bool named = !surroundings.machines.empty();
  if (named)
    command.words.insert(command.words.end(), {"--host", host_list(surroundings.machines)});
  else if (!options.hostfile.empty())
    command.words.insert(command.words.end(), {"--hostfile", options::word_of_file(options.hostfile)});
  const std::uint32_t slots = surroundings.tasks != 0 ? surroundings.tasks : surroundings.cores;
  // Machines that are named have their own slots; what is more than these goes round over them.
  if (named || !options.hostfile.empty() || options.nodes + 1 > slots) command.words.emplace_back("--oversubscribe");
  return command;
}

}  // namespace

child::Command mpi_start(const options::RenderOptions& options, const Programs& programs,
                         const Surroundings& surroundings) {
  if (!options.hostfile.empty()) read_hostfile(options.hostfile);  // what is wrong with it shows before mpirun's words
  if (surroundings.address_limit != 0 && surroundings.address_limit < kLeastForMpi)
    throw Failure("the limit of " + std::to_string(surroundings.address_limit >> 10) +
                      " kB of addresses a process is too small for MPI",
                  "ulimit -v", "raise it to " + std::to_string(kLeastForMpi >> 10) + " or more: ulimit -v unlimited");
  Surroundings known = surroundings;
  if (known.machines.empty() && options.hostfile.empty()) known.machines = named_machines("", surroundings.environment);
  child::Command command =
      programs.mpi == Mpi::mpich ? mpich_start(options, programs, known) : open_mpi_start(options, programs, known);
  // After sbatch --export=NONE srun, by which mpirun reaches other machines, would start its helpers without PATH.
  if (surroundings.environment.value("SLURM_EXPORT_ENV")) command.environment.emplace_back("SLURM_EXPORT_ENV", "ALL");
  return command;
}

void add_program(child::Command& command, std::uint32_t count, const fs::path& program, const Programs& programs,
                 const Surroundings& surroundings) {
  if (programs.mpi == Mpi::open_mpi)
    for (const std::string& name : surroundings.settings) command.words.insert(command.words.end(), {"-x", name});
  command.words.insert(command.words.end(), {"-n", std::to_string(count), program.string()});
}

}  // namespace mars::launch
