// The jobs of a batch system that were submitted for a folder of frames: DIR/.slurm or the like, with the script of the
// last one, what they print, jobs.json, which names them, and `again`, a line for each that a job itself has submitted.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/shell/batch/batch_system.h"
#include "host/shell/batch/queued_jobs.h"

namespace mars::batch {

class RememberedJobs {
 public:
  RememberedJobs(const std::filesystem::path& frames, const BatchSystem& system)
      : system_(system), folder_(frames / system.folder) {}
  RememberedJobs(const std::filesystem::path&, const BatchSystem&&) = delete;

  // Makes the folder, and forgets how often a job was queued again in vain. Both throw Failure where a file cannot be
  // written.
  void write_script(const std::string& text) const;
  void add(const std::string& number) const;

  // By number, as they were submitted; none where there is no folder. Throws Failure where jobs.json says nothing
  // sound.
  std::vector<std::string> numbers() const;

 private:
  std::filesystem::path jobs_file() const { return folder_ / "jobs.json"; }
  std::vector<std::string> submitted() const;

  const BatchSystem& system_;
  std::filesystem::path folder_;
};

// The lists of all batch systems that have jobs there.
std::vector<Jobs> jobs_of(const std::filesystem::path& frames);

}  // namespace mars::batch
