// What goes on in a folder of frames: how much is there, the runs that render into it, with their machines, and the
// batch jobs that were submitted for it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/render/sinks/claim.h"
#include "host/render/sinks/status.h"
#include "host/shell/batch/queued_jobs.h"

namespace mars::batch {

struct FolderState {
  struct Run {
    sinks::Claim claim;
    bool ended = false;                   // seen from here: its process is gone
    std::int64_t silent = 0;              // seconds since it has said anything, by its clock and this machine's
    std::optional<sinks::Status> status;  // none: it has none yet

    bool lives() const;
  };

  std::string folder;
  std::string film;         // "" where no run has begun
  std::uint32_t there = 0;  // frames
  std::uint32_t of = 0;     // that runs were asked for so far
  std::vector<Run> runs;
  std::vector<QueuedJob> jobs;
  sinks::Usage used;    // by all runs so far
  std::string no_jobs;  // why they are unknown

  bool complete() const { return of > 0 && there == of; }
  // Whether anything renders or will, or may where jobs are unknown.
  bool active() const;
};

// Throws Failure where there is neither a manifest nor a job, or one of their files is damaged.
FolderState look_at(const std::filesystem::path& folder);

// "12.34 processor hours, 1.2 GB written, 1 restart", of short runs seconds; "" where nothing was used.
std::string text_of(const sinks::Usage& used);

// A line for the folder, each job and each run; with `machines` also one for what was used, and below each run a line
// for each of its machines and for its last warnings.
std::vector<std::string> lines_of(const FolderState& state, bool machines);

}  // namespace mars::batch
