// Runs programs that are written for NX: one host and its nodes, or nodes alone.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace mars::nx_jobs {

inline constexpr int kMostNxNodes = 1 << 12;

enum class Over { automatic, processes, mpi };  // what carries the messages

struct NxRun {
  int nodes = 0;      // 0: one a processor, or the slots of the hostfile or the batch system
  bool host = false;  // the first program is the host, also where it is the only one
  Over over = Over::automatic;
  std::string hostfile;                // Open MPI's; "": none
  std::vector<std::string> words;      // the programs, and arguments after two of them
  std::vector<std::string> arguments;  // of every program
};

struct NxPrograms {
  std::filesystem::path host;  // empty: none
  std::filesystem::path node;  // as `host`
};

// Runs the programs as processes of this machine, with at most `limit` bytes of messages in flight; their highest exit
// code. The program that links the transport gives it.
using RunProcesses = std::function<int(const NxRun& job, const NxPrograms& programs, std::uint64_t limit)>;

// Their highest exit code, as of a shell: 128 and the signal for one that died of it. Over MPI it is mpirun's.
int run_nx(NxRun job, const RunProcesses& run_processes);

}  // namespace mars::nx_jobs
