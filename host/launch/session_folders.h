// Where Open MPI keeps its files while a job runs on this machine alone: a folder of the job's own among the temporary
// files and one in shared memory, so that what a killed job left is known and goes.
//
// A folder is locked by whoever started the job and by its mpirun. The lock ends with them, however they end, and says
// so to everybody who sees the folder: other jobs of the user, also those in containers that share it.
#pragma once

#include <filesystem>
#include <vector>

#include "host/launch/command.h"

namespace mars::host {

class SessionFolders {
 public:
  // First removes what this user's jobs left that have ended on this machine. Then, where `command` wants them, makes
  // the folders and names them in its environment; without those that cannot be made or that a person named.
  explicit SessionFolders(Command& command);
  ~SessionFolders();  // removes them
  SessionFolders(const SessionFolders&) = delete;
  SessionFolders& operator=(const SessionFolders&) = delete;

  // For a process that becomes mpirun: another one removes them when mpirun has ended.
  void leave_to_another() const;

 private:
  struct Folder {
    std::filesystem::path path;
    int lock;  // passed on to mpirun
  };

  bool make_in(const std::filesystem::path& base);

  std::vector<Folder> folders_;
};

}  // namespace mars::host
