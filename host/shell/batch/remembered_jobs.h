// The Slurm jobs that were submitted for a folder of frames: DIR/.slurm, with the script of the last one, what they
// print, and jobs.json, which names them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mars::batch {

class RememberedJobs {
 public:
  explicit RememberedJobs(const std::filesystem::path& frames) : folder_(frames / ".slurm") {}

  // Makes the folder. Both throw Failure where a file cannot be written.
  std::filesystem::path write_script(const std::string& text) const;
  void add(const std::string& number) const;

  // By number, as they were submitted; none where there is no folder. Throws Failure where jobs.json says nothing
  // sound.
  std::vector<std::string> numbers() const;
  // Of what a job prints, as sbatch takes it: a file for each, and for each task of an array.
  std::string output_pattern(bool array) const;

 private:
  std::filesystem::path jobs_file() const { return folder_ / "jobs.json"; }

  std::filesystem::path folder_;
};

}  // namespace mars::batch
