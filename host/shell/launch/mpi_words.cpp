#include "host/shell/launch/mpi_words.h"

#include <algorithm>
#include <array>

#include "host/shell/launch/text_reader.h"

namespace mars::launch {
namespace {

constexpr const char* kTooFewSlots = "the allocation has too few slots for the host and the nodes";
constexpr const char* kAskForMore = "use fewer --nodes, or ask for one task more than nodes";
constexpr const char* kWrongMpi = "this mpirun is not of the MPI that MARS was built with";
constexpr const char* kOneMpi =
    "load the MPI that MARS was built with (module load ...), or build MARS again with this one";
constexpr const char* kWrongHostfile = "the hostfile has a line that Open MPI does not take";
constexpr const char* kHostfileForm = "write a line a host, like: n1 slots=4";
constexpr const char* kNotAllocated = "the hostfile names a machine that the batch system did not give to this job";
constexpr const char* kUseAllocated = "name only machines of the job, or leave out --hostfile";
constexpr const char* kMakeShmLarger =
    "enlarge /dev/shm: mount -o remount,size=1G /dev/shm, or start the container with --shm-size=1g";

constexpr std::string_view kNoLibrary = "error while loading shared libraries:";
constexpr const char* kNoPrograms = "a machine does not have MARS's programs";

constexpr std::array kTable = {
    MpiWords{"not enough slots available", kTooFewSlots, kAskForMore},
    MpiWords{"are already filled", kTooFewSlots, kAskForMore},
    MpiWords{"detected an attempt to run as root", "Open MPI does not start as root",
             "use another user, or set OMPI_ALLOW_RUN_AS_ROOT=1 and OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1"},
    MpiWords{
        kNoLibrary, "a machine lacks a library that MARS was built with",
        "install it there, or name its folder in LD_LIBRARY_PATH (module load ...) where you start: MARS hands it on; "
        "or install MARS by cmake --install, whose programs know the folders of their libraries"},
    MpiWords{"unrecognized argument", kWrongMpi, kOneMpi},
    MpiWords{"Error: unknown option", kWrongMpi, kOneMpi},
    MpiWords{"execvp error on file", kNoPrograms,
             "put them under the same path on every machine, as on a shared file system"},
    MpiWords{"HYDRA", kWrongMpi, kOneMpi},
    MpiWords{"call to mkdir was unable to create", "Open MPI cannot write its temporary files",
             "set TMPDIR to a folder on a local disk that you may write, on every machine"},
    MpiWords{"orte_session_dir failed", "Open MPI cannot write its temporary files",
             "set TMPDIR to a folder on a local disk that you may write, on every machine"},
    MpiWords{"parse error in the hostfile", kWrongHostfile, kHostfileForm},
    MpiWords{"bad parameter in the hostfile", kWrongHostfile, kHostfileForm},
    MpiWords{"multiple definitions of the slot count", "the hostfile gives the slots of a machine twice",
             "give them once: localhost and this machine's own name are one machine"},
    MpiWords{"regular expression of the node names", "the hostfile has a name that Open MPI takes for no machine",
             "use names of letters, digits, - and . only"},
    MpiWords{"not included in the current allocation", kNotAllocated, kUseAllocated},
    MpiWords{"not present in the allocation", kNotAllocated, kUseAllocated},
    MpiWords{"relative host was specified",
             "the hostfile names a machine by its number in an allocation that has none such",
             "write the machine's name instead of +n0"},
    MpiWords{"unable to open the hostfile", "mpirun cannot open the hostfile",
             "check that the file is there and can be read"},
    MpiWords{"Too many open files", "mpirun or a node may not open as many files as it must", "ulimit -n 1024"},
    MpiWords{"No space left on device", "a disk is full", "empty it, or set TMPDIR to a folder with free space"},
    MpiWords{"listener thread failed to start", "Open MPI finds no address 127.0.0.1 on this machine",
             "ip link set lo up gives it, or use --backend threads"},
    MpiWords{"plm_rsh_agent", "there is neither ssh nor rsh to reach the other machines with",
             "install ssh (Debian: openssh-client), or start inside a Slurm job"},
    MpiWords{"could not access or execute an executable", kNoPrograms,
             "put them under the same path on every machine, as on a shared file system"},
    MpiWords{"unable to find the specified executable file", kNoPrograms,
             "put them under the same path on every machine, as on a shared file system"},
    MpiWords{"unable to reliably start one or more daemons", "Open MPI cannot start on another machine",
             "ssh MACHINE true must work without a password, and Open MPI be under the same path on each"},
    MpiWords{"unexpectedly failed after launch", "Open MPI's daemon on another machine cannot reach this one",
             kOpenPorts},
    MpiWords{"lost communication with a remote daemon", "a machine was lost",
             "check whether it still runs; the same command goes on"},
    MpiWords{"unable to complete a TCP connection", "two machines cannot reach each other", kOpenPorts},
    MpiWords{"connect() to ", "two machines cannot reach each other", kOpenPorts},
    MpiWords{"Read -1, expected", "the system forbids processes to copy from each other's memory",
             "export OMPI_MCA_btl_vader_single_copy_mechanism=none, or give the container "
             "--cap-add=SYS_PTRACE"},
    MpiWords{"not enough space for", "there is too little shared memory for messages", kMakeShmLarger},
};

std::string machine_of(std::uint32_t rank, const std::vector<Slots>& machines) {
  for (const Slots& each : machines) {
    if (rank < each.count) return each.host;
    rank -= each.count;
  }
  return "";
}

// "/opt/mars-node: error while loading shared libraries: libpng16.so.16: cannot open shared object file: ...", and
// later "Process name: [[6930,1],2]", which is the rank of the process that ended first.
std::optional<Failure> unloaded_library(const std::string& line, const std::vector<Slots>& machines,
                                        const char* remedy) {
  std::string_view program = std::string_view(line).substr(0, line.find(kNoLibrary));
  std::string library = word_behind(line, kNoLibrary).value_or("");
  if (!program.ends_with(": ") || !library.ends_with(':')) return std::nullopt;
  program.remove_suffix(2);
  program.remove_prefix(program.rfind(' ') + 1);
  library.pop_back();
  TextReader words(line);
  const auto rank = words.find("Process name: [[") && words.find("],") ? words.number() : std::nullopt;
  const std::string machine = rank ? machine_of(*rank, machines) : "";
  return Failure(std::string(program) + " cannot load the library " + library,
                 machine.empty() ? "" : "machine " + machine, remedy);
}

// "Executable: /opt/mars-node", and before or behind it "Node: n3".
std::optional<Failure> missing_program(const std::string& line, const char* remedy) {
  const auto program = word_behind(line, "Executable:"), machine = word_behind(line, "Node:");
  if (!program || !machine) return std::nullopt;
  return Failure("there is no program " + *program + " that can be run", "machine " + *machine, remedy);
}

}  // namespace

std::span<const MpiWords> mpi_words() { return kTable; }

std::optional<Failure> meaning_of(const std::string& text, const std::vector<Slots>& machines) {
  const std::string line = on_one_line(text);
  const auto* known = std::find_if(kTable.begin(), kTable.end(),
                                   [&](const MpiWords& each) { return line.find(each.words) != std::string::npos; });
  if (known == kTable.end()) return std::nullopt;
  std::optional<Failure> named;
  if (known->words == kNoLibrary) named = unloaded_library(line, machines, known->remedy);
  if (known->problem == kNoPrograms) named = missing_program(line, known->remedy);
  return named ? named : Failure(known->problem, "", known->remedy);
}

}  // namespace mars::launch
