// Other runs' claims in the way of a new one, whose processes cannot be seen from here, as they are on other machines.
// One that lives renews its claim every 10 seconds, and is refused to as soon as that is seen; one that has ended only
// grows old. So a new run does not fail by the claim of a lost machine, but waits until it counts no more.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <string>

#include "host/render/sinks/folder_turn.h"
#include "host/render/sinks/runs_folder.h"

namespace mars::sinks {

// Takes a line about what a person may wonder at.
using Warn = std::function<void(const std::string& line)>;

class UnseenRivals {
 public:
  // Longer than the claim of a run that has ended counts.
  static constexpr std::chrono::seconds kPatience{70};

  explicit UnseenRivals(Warn warn) : warn_(std::move(warn)) {}

  // Whether the run, which is in the way by `reason`, may have ended: then it is to be asked again, in a second. Warns
  // once of each.
  bool may_have_ended(const RunFiles& run, const FolderTurn& turn, const std::string& reason);

 private:
  struct Seen {
    double last_sign;  // when it was seen first
    std::chrono::steady_clock::time_point since;
  };

  Warn warn_;
  std::map<std::string, Seen> seen_;  // by the run's name
};

}  // namespace mars::sinks
