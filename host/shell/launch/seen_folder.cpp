#include "host/shell/launch/seen_folder.h"

#include <system_error>

#include "host/render/sinks/restore.h"
#include "host/render/sinks/runs_folder.h"

namespace mars::launch {
namespace {

namespace fs = std::filesystem;

// File systems of networks remember for half a minute that a name was not there, unless its folder is opened.
bool is_there(const fs::path& file) {
  std::error_code none;
  if (fs::exists(file, none)) return true;
  for (fs::path folder = fs::absolute(file, none); folder.has_relative_path();) {
    folder = folder.parent_path();
    const fs::directory_iterator opened(folder, none);
  }
  return fs::exists(file, none);
}

}  // namespace

bool SeenFolder::look(const std::string& run, Clock::time_point now) {
  if (folder_.empty() || run.empty() || sees_) return false;
  return note(is_there(folder_ / sinks::kRunsName / (run + std::string(sinks::kClaimEnding))), now);
}

void SeenFolder::look_for_frames(Clock::time_point now) {
  if (is_open()) note(is_there(folder_ / sinks::kManifestName), now);
}

bool SeenFolder::note(bool there, Clock::time_point now) {
  if (!since_) since_ = now;
  if (there) sees_ = true;
  if (!there && now - *since_ >= kPatience) sees_ = false;
  return is_missed();
}

}  // namespace mars::launch
