// A run's claim to a folder of frames: which frames of which film it renders, from its start to its end. Runs of the
// same compiled film share a folder while no frame is claimed twice; whatever else would mix two runs' frames is
// refused. What is claimed, and what has been rendered of it, outlives a run that is killed: the next one adds it to
// frames.json.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>

#include "hal/failure/failure.h"
#include "host/render/sinks/manifest.h"
#include "host/render/sinks/process_name.h"
#include "host/render/sinks/runs_folder.h"

namespace mars::sinks {

struct Claim {
  ProcessName process;
  std::int64_t since = 0;  // seconds since 1970, by the process's own clock
  Manifest manifest;       // without hashes
};

std::string text_of(const Claim& claim);

bool has_claim(const RunFiles& run);
// None where the run has none (any more), or what it has is none. Throws Failure where its file cannot be read.
std::optional<Claim> claim_of(const RunFiles& run);

// What a run has rendered so far: its claim's manifest with the hashes of the frames it has written; none where it
// has no claim. Throws Failure where a file cannot be read.
std::optional<Manifest> rendered_by(const RunFiles& run);

// A run's .hashes, as it grows.
class HashLog {
 public:
  // A new file. Throws Failure where it cannot be made.
  explicit HashLog(std::filesystem::path file);
  ~HashLog();
  HashLog(const HashLog&) = delete;
  HashLog& operator=(const HashLog&) = delete;

  // From several threads at once. Where it throws, it may be called again. A line that is not whole is ended before
  // another begins, so that half a line is only ever the last; a line may be there twice. A loss of power takes the
  // lines of a second or so.
  void add(std::uint32_t frame, const std::string& hash);

 private:
  using Clock = std::chrono::steady_clock;

  void write_rest();
  void sync_now_and_then();

  const std::filesystem::path file_;
  const int number_;
  std::mutex mutex_;  // one line at a time; guards:
  std::string rest_;  // of a line that is not whole in the file
  Clock::time_point synced_ = Clock::now();
};

// Where the run's claim and `wanted` would be mixed: names the run and what it renders.
std::optional<Failure> conflict_with(const RunFiles& run, const Manifest& wanted, const std::filesystem::path& folder);

}  // namespace mars::sinks
