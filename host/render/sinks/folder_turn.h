// One run at a time decides what becomes of a folder of frames: which claims there are, and what frames.json says. This
// is its turn. It needs no locks of the file system, which not all that several machines share have, but only that a
// process that has made or renamed a file sees it, and those made before, in every later listing of the folder:
//   1. A run that wants the turn has a file NAME.waits. Once it sees no NAME.turn that is less than its own, it renames
//      its file to NAME.turn, and lists the folder.
//   2. If it sees another's .turn that is less than its own, it takes its own back (to .waits) and begins again.
//   3. If those that it sees are all greater, it waits until they are gone. If it sees none, it is its turn.
// Of two runs, the one that made its .turn later has listed the other's: the greater one gives way, the lesser one
// waits. So both never have the turn, and the least of those that wait gets it. A .turn whose run has ended does not
// count. Names are never used twice, so nobody can remove another's .turn in place of the one that was seen.
#pragma once

#include <chrono>
#include <filesystem>
#include <vector>

#include "host/render/sinks/growing_pauses.h"
#include "host/render/sinks/runs_folder.h"

namespace mars::sinks {

class FolderTurn {
 public:
  // Longer than the turn of a run on a lost machine counts.
  static constexpr std::chrono::milliseconds kPatience{90000};

  // Waits for it. `runs` must outlive the turn. Throws Failure where it does not come in time, as another run that has
  // it does not go on, or where the folder cannot be written.
  explicit FolderTurn(const RunsFolder& runs, std::chrono::milliseconds patience = kPatience);
  ~FolderTurn();
  FolderTurn(const FolderTurn&) = delete;
  FolderTurn& operator=(const FolderTurn&) = delete;

  // The file that stands for it.
  const std::filesystem::path& file() const { return file_; }

  // Throws Failure where others have taken this run for ended, which was held up, or its file cannot be renewed.
  void confirm() const;

  // Whether a run has ended: its process is gone; or, where that cannot be seen from here, none of its files was made
  // or renewed in the last minute, by the clock of the machine that keeps the files.
  bool has_ended(const RunFiles& run) const;
  // Whether its process can be looked up from here.
  bool sees(const RunFiles& run) const;
  // When one of its files was made or renewed last, in seconds by that clock; 0: none is there any more.
  static double last_sign_of(const RunFiles& run);

 private:
  using Clock = std::chrono::steady_clock;

  void wait();
  void pause();
  bool take();
  std::vector<RunFiles> rivals() const;
  void rename_to(std::string_view ending);
  [[noreturn]] void fail_late() const;
  // Its file could not be changed.
  [[noreturn]] void fail(const char* act, int error) const;

  const RunsFolder& runs_;
  std::filesystem::path file_;
  Clock::time_point deadline_;
  GrowingPauses pauses_;
};

}  // namespace mars::sinks
