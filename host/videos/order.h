// What somebody asks of a video, and what he hears while it is made.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "host/content/document/work_folder.h"
#include "host/videos/audio.h"
#include "host/videos/ffmpeg.h"
#include "host/videos/video_form.h"

namespace mars::videos {

inline constexpr std::size_t kPieceFrames = 240;  // about as many as encoders put between pictures that stand alone

struct Order {
  std::filesystem::path file;
  FormWish form{};
  std::optional<Audio> audio{};
  std::string recipe{};  // as Mark's
  std::size_t piece_frames = kPieceFrames;
  bool overwrite = false;                      // a file that is there, also one that MARS has not made
  const document::WorkFolder* work = nullptr;  // the file's, where the caller alone uses it; none: write_video makes it
};

struct Listener {
  std::function<void(std::size_t done, std::size_t of)> encoded{};  // pictures
  std::function<void(const std::string& line)> note{};              // about what the video is other than expected
  Bounds bounds{};
};

}  // namespace mars::videos
