// Jobs of a batch system, by its own commands.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/shell/batch/ask.h"
#include "host/shell/batch/batch_script.h"
#include "host/shell/batch/batch_system.h"

namespace mars::batch {

// A job, or one task of a job's array, that has not ended.
struct QueuedJob {
  std::string id;     // "12", "12_3"; "12_[4-9]" for tasks that wait
  std::string state;  // a word, such as running or pending
  std::string time;   // since its start: "1:02:03"
  std::uint32_t restarts = 0;
  std::string machines;  // "n[1-4]"
  std::string reason;    // why it waits; ""

  bool operator==(const QueuedJob&) const = default;
};

// "job 12: running on n[1-4] for 0:20, 1 restart"
std::string text_of(const QueuedJob& job);

// A line of the system's list; none: of a job that has ended. Throws Failure where it is no such line.
std::optional<QueuedJob> queued_job_of(const BatchSystem& system, const std::string& line);

// Whether a text may name a job: it is one word that is no option.
bool is_job_number(const std::string& text);

struct Jobs {
  const BatchSystem* system;
  std::vector<std::string> numbers;
};

// All that follow throw Failure where the system's program is not there or refuses, with its own words, or NoAnswer.

// Returns the job's number.
std::string submit_job(const BatchSystem& system, const BatchJob& job,
                       std::chrono::milliseconds longest = kLongestAnswer);
// Those that have not ended.
std::vector<QueuedJob> queued_jobs(const std::vector<Jobs>& all, std::chrono::milliseconds longest = kLongestAnswer);
void cancel_jobs(const std::vector<Jobs>& all, std::chrono::milliseconds longest = kLongestAnswer);

// Why the job may never run, or never come to a frame, each as a line; none where nothing is known in time.
std::vector<std::string> doubts_of(const BatchSystem& system, const BatchJob& job,
                                   std::chrono::milliseconds longest = std::chrono::seconds(5));

}  // namespace mars::batch
