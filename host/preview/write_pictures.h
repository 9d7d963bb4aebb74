// Pictures of a film into a file: one PNG, a contact sheet, or a video. Whole or not at all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "host/content/film/frame_set.h"
#include "host/preview/pictures.h"

namespace mars::preview {

struct WriteOptions {
  std::filesystem::path file;                 // .png, .gif or .mp4
  std::optional<film::FrameSet> frames;       // none: all, or for a sheet kSheetFrames at most
  std::uint32_t every = 1;                    // of the frames only each Nth
  std::uint32_t columns = 0;                  // of a sheet; 0: about as many as rows
  std::optional<images::PictureSize> extent;  // of each picture; none: the film's, smaller on a sheet and in a GIF
};

inline constexpr std::uint32_t kSheetFrames = 12;

// Throws Failure unless the file's ending is one of those.
void check_kind(const std::filesystem::path& file);

// The frames that are written of a film with `film_frames`, ascending.
std::vector<std::uint32_t> frames_to_write(const WriteOptions& options, std::uint32_t film_frames);
images::PictureSize extent_to_write(const WriteOptions& options, images::PictureSize film, std::size_t frames);

// `pictures` must have every picture ready.
void write_pictures(Pictures& pictures, const WriteOptions& options);

}  // namespace mars::preview
