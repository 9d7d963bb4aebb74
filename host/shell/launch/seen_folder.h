// Whether this machine sees the folder into which a job's host writes. The host may be on another machine, which
// may have a folder of its own by this name.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

namespace mars::launch {

class SeenFolder {
 public:
  using Clock = std::chrono::steady_clock;

  static constexpr std::chrono::seconds kPatience{10};  // file systems of networks show late what others have made

  // "": frames go nowhere.
  explicit SeenFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // While the job runs: for the claim of `run`, the name of the host's run; "": it has none yet. Whether it is known
  // from now on that this machine does not see the folder.
  bool look(const std::string& run, Clock::time_point now);
  // When the job has ended well, and its claim is gone: for what a folder of frames has.
  void look_for_frames(Clock::time_point now);
  // It is not known yet, but will be.
  bool is_open() const { return since_ && !sees_; }
  // This machine does not see it.
  bool is_missed() const { return sees_ == false; }

 private:
  bool note(bool there, Clock::time_point now);

  const std::filesystem::path folder_;
  std::optional<Clock::time_point> since_;  // it was looked for
  std::optional<bool> sees_;
};

}  // namespace mars::launch
