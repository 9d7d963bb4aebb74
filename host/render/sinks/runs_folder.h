// DIR/.runs: what the runs that write into a folder of frames let each other know, and what they are still writing. The
// files of a run begin with its own name, which no other run ever has, so one that finds a run ended may remove them:
//   NAME.claim     which frames of which film it renders, and which process it is (claim.h); from its start to its end
//   NAME.hashes    a line for each frame that it has written: number and pixel hash
//   NAME.status    how it goes (status.h)
//   NAME.*.part    a file that is not whole yet
//   NAME.waits, NAME.turn    it waits for its turn, or asks for it or has it (folder_turn.h)
// The folder is there only while there is something in it.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "host/render/sinks/process_name.h"

namespace mars::sinks {

inline constexpr std::string_view kRunsName = ".runs";
inline constexpr std::string_view kClaimEnding = ".claim";
inline constexpr std::string_view kHashesEnding = ".hashes";
inline constexpr std::string_view kStatusEnding = ".status";
inline constexpr std::string_view kWaitsEnding = ".waits";
inline constexpr std::string_view kTurnEnding = ".turn";

struct RunFiles {
  std::string run;  // its name
  std::vector<std::filesystem::path> files;
};

class RunsFolder {
 public:
  // Of the folder of frames `frames`, as the process `self` sees it, which becomes a run of a new name. Makes nothing
  // yet.
  RunsFolder(const std::filesystem::path& frames, ProcessName self);

  const ProcessName& self() const { return self_; }
  const std::string& own_name() const { return name_; }
  std::filesystem::path own_file(std::string_view ending) const;
  bool exists() const;

  // A new file of this run; makes the folder where it is missing, with the permissions of the folder of frames. Throws
  // Failure where it cannot, or something that is no folder has its name.
  std::filesystem::path add_own_file(std::string_view ending, std::string_view text) const;
  void remove_own_files() const;
  // Of every run, by name; none where there is no folder. Throws Failure where it cannot be listed, or has something
  // in it that is no regular file.
  std::vector<RunFiles> runs() const;
  void remove_if_empty() const;

 private:
  void make() const;

  std::filesystem::path frames_, path_;
  ProcessName self_;
  std::string name_;
};

// The process that a run's files name; one of no number where none of them can be read.
ProcessName process_of(const RunFiles& run);

}  // namespace mars::sinks
