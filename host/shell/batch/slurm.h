// Slurm by its own commands: sbatch, squeue and scancel.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace mars::batch {

// A job, or one task of a job's array, that has not ended.
struct QueuedJob {
  std::string id;     // "12", "12_3"; "12_[4-9]" for tasks that wait
  std::string state;  // Slurm's word: PENDING, RUNNING, COMPLETING ...
  std::string time;   // since its start: "1:02:03"
  std::uint32_t restarts = 0;
  std::string machines;  // "n[1-4]"
  std::string reason;    // why it waits; "" or None

  bool operator==(const QueuedJob&) const = default;
};

// "job 12: running on n[1-4] for 0:20, 1 restart"
std::string text_of(const QueuedJob& job);

// A line of squeue, as queued_jobs asks for it; its fields end with bars. Throws Failure where it is none.
QueuedJob queued_job_of(const std::string& line);

// All throw Failure where the command is not there or refuses, with its own words.

// Throws where there is no Slurm on this machine.
void check_slurm();
// Returns the job's number. `output` is sbatch's pattern; `more` are a person's options for sbatch.
std::string submit_job(const std::filesystem::path& script, const std::string& output,
                       const std::vector<std::string>& more);
// The jobs with the numbers `numbers` that have not ended.
std::vector<QueuedJob> queued_jobs(const std::vector<std::string>& numbers);
void cancel_jobs(const std::vector<std::string>& numbers);

}  // namespace mars::batch
