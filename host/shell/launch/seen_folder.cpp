#include "host/shell/launch/seen_folder.h"

#include <system_error>

#include "host/render/sinks/restore.h"
#include "host/render/sinks/runs_folder.h"

namespace mars::launch {
namespace {

bool is_there(const std::filesystem::path& file) {
  std::error_code none;
  return std::filesystem::exists(file, none);
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
