// Where Open MPI keeps its files while a job runs on this machine alone: a folder of the job's own among the temporary
// files and one in shared memory, so that what a killed job left is known and goes.
//
// A folder is locked by the process that started the job and by its mpirun. The lock ends with them, however they end,
// and says so to everybody who sees the folder: other jobs of the user, also those in containers that share it.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <initializer_list>
#include <optional>
#include <utility>
#include <vector>

#include "host/child/command.h"

namespace mars::launch {

// For a rank of Open MPI before it joins its job. The first of a machine removes there what this user's jobs left whose
// processes were killed: folders of sessions and shared memory that no process holds.
void clean_machine_as_rank();

// Removes what a job on several machines, whose mpirun has ended here, left on this machine if mpirun was killed: its
// folder and the memory that its ranks shared.
void remove_session_of(pid_t mpirun);

class SessionFolders {
 public:
  // First removes what this user's jobs left that have ended on this machine. Then, where `command` needs them, makes
  // the folders and names them in its environment; without those that cannot be made or that a person named.
  explicit SessionFolders(child::Command& command);
  ~SessionFolders() = default;  // removes them
  SessionFolders(const SessionFolders&) = delete;
  SessionFolders& operator=(const SessionFolders&) = delete;

 private:
  // Locked by us, and removed at its end.
  class Folder {
   public:
    Folder(std::filesystem::path path, int lock) : path_(std::move(path)), lock_(lock) {}
    ~Folder();
    Folder(Folder&& other) noexcept : path_(std::move(other.path_)), lock_(std::exchange(other.lock_, -1)) {}
    Folder& operator=(Folder&&) = delete;

    const std::filesystem::path& path() const { return path_; }

   private:
    std::filesystem::path path_;
    int lock_;  // passed on to mpirun; -1: moved away
  };

  static std::optional<Folder> make_in(const std::filesystem::path& base);
  // A folder in `base` for those of the settings that no person has set.
  void add(const std::filesystem::path& base, std::initializer_list<const char*> settings, child::Command& command);

  std::vector<Folder> folders_;
};

}  // namespace mars::launch
