#include "host/studio/rendering/finished_frames.h"

#include <algorithm>
#include <map>
#include <string_view>

#include "hal/failure/explain.h"
#include "hal/failure/failure.h"
#include "host/content/document/text.h"
#include "host/images/picture_file.h"
#include "host/render/sinks/claim.h"
#include "host/render/sinks/restore.h"
#include "host/render/sinks/runs_folder.h"

namespace mars::studio {
namespace {

namespace fs = std::filesystem;

std::map<std::uint32_t, fs::path> files_of(const fs::path& folder) {
  std::map<std::uint32_t, fs::path> files;
  const std::optional<sinks::Manifest> manifest = sinks::read_frames_json(folder);
  if (!manifest || images::is_exr(manifest->format)) return files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (const auto frame = sinks::frame_of_file(*manifest, entry.path().filename().string()))
      files.emplace(*frame, entry.path());
  return files;
}

void look_at_runs(const fs::path& folder, FolderLook& look) {
  const sinks::ProcessName self = sinks::this_process();
  for (const sinks::RunFiles& run : sinks::RunsFolder(folder, self).runs()) {
    const auto claim = sinks::claim_of(run);
    if (!claim || sinks::is_running(claim->process, self) == sinks::Running::no) continue;
    look.runs = true;
    const auto status = sinks::status_of(run);
    if (status && (!look.status || status->written > look.status->written)) look.status = status;
  }
}

}  // namespace

FolderLook look_at_frames(const fs::path& folder) try {
  FolderLook look;
  fs::file_time_type last = fs::file_time_type::min();
  for (const auto& [frame, file] : files_of(folder)) {
    look.frames.push_back(frame);
    std::error_code gone;
    const auto time = fs::last_write_time(file, gone);
    if (gone || time < last) continue;
    last = time;
    look.newest = frame;
  }
  look_at_runs(folder, look);
  return look;
} catch (const std::exception& failure) {
  FolderLook look;
  look.problem = reason_of(failure);
  return look;
}

images::Image read_frame(const fs::path& folder, std::uint32_t frame) {
  const auto files = files_of(folder);
  const auto found = files.find(frame);
  if (found == files.end()) throw Failure("frame " + std::to_string(frame) + " is not there yet", folder.string(), "");
  return images::read_opaque(found->second);
}

}  // namespace mars::studio
