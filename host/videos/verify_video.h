// Looks a video over: does all of it decode, and has it the frames, the size and the rate that its mark (mark.h) says?
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/videos/mark.h"
#include "host/videos/probe.h"

namespace mars::videos {

struct VideoVerdict {
  Probed found;
  std::optional<Mark> mark;           // none: it says nothing of a film
  std::uint64_t decoded = 0;          // pictures
  std::vector<std::string> troubles;  // "has 47 of 48 frames"
  std::string hash;                   // checksum of all decoded pictures
};

// Throws Failure where the file is missing, or ffmpeg is.
VideoVerdict verify_video(const std::filesystem::path& file);

}  // namespace mars::videos
