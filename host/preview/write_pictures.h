// Pictures of a film into a file: one PNG, a contact sheet, or a video (host/videos/). Whole or not at all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "host/content/film/frame_set.h"
#include "host/preview/folder_pictures.h"
#include "host/preview/pictures.h"
#include "host/videos/write_video.h"

namespace mars::preview {

struct WriteOptions {
  std::filesystem::path file;                 // .png, or a video's
  std::optional<film::FrameSet> frames;       // none: all, or for a sheet kSheetFrames at most
  std::uint32_t every = 1;                    // of the frames only each Nth
  std::uint32_t columns = 0;                  // of a sheet; 0: about as many as rows
  std::optional<images::PictureSize> extent;  // of each picture; none: the film's, smaller on a sheet and in a GIF
  videos::FormWish form{};                    // of a video
  std::optional<videos::Audio> audio{};       // of a video
};

inline constexpr std::uint32_t kSheetFrames = 12;

// Throws Failure unless the file's ending is one of those.
void check_kind(const std::filesystem::path& file);

// The frames that are written of a film with `film_frames`, ascending.
std::vector<std::uint32_t> frames_to_write(const WriteOptions& options, std::uint32_t film_frames);
images::PictureSize extent_to_write(const WriteOptions& options, images::PictureSize film, std::size_t frames);

// `pictures` must have every picture ready. `listener` hears about a video.
void write_pictures(Pictures& pictures, const WriteOptions& options, const videos::Listener& listener);

// A video of a folder's frames, which goes on where it stopped.
void write_folder_video(const FolderPictures& pictures, const WriteOptions& options, const videos::Listener& listener);

}  // namespace mars::preview
