// A folder of frames, as runs leave it. These functions read files, which may take long.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/images/image.h"
#include "host/render/sinks/status.h"

namespace mars::studio {

struct FolderLook {
  std::vector<std::uint32_t> frames;    // that are there, ascending
  std::optional<std::uint32_t> newest;  // of the frames
  bool runs = false;                    // somebody renders into it
  std::optional<sinks::Status> status;  // of the one that said something last
  std::string problem;                  // why it cannot be looked at; "": it can
};

FolderLook look_at_frames(const std::filesystem::path& folder);

// Throws Failure where it is not there, or torn.
images::Image read_frame(const std::filesystem::path& folder, std::uint32_t frame);

}  // namespace mars::studio
