// Pictures into a video, which appears whole or not at all. Where it is known what decides each picture, they are
// encoded in pieces, kept in a folder beside the file, FILE.pieces, until the video is there: whoever makes it again,
// also of frames of which some have changed, encodes only the pieces that are not there yet. Pieces are then joined
// without being encoded again.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "host/videos/audio.h"
#include "host/videos/ffmpeg.h"
#include "host/videos/source.h"
#include "host/videos/video_form.h"

namespace mars::videos {

inline constexpr std::size_t kPieceFrames = 240;  // about as many as encoders put between pictures that stand alone

struct Order {
  std::filesystem::path file;
  FormWish form{};
  std::optional<Audio> audio{};
  std::string recipe{};  // as Mark's
  std::size_t piece_frames = kPieceFrames;
};

struct Listener {
  std::function<void(std::size_t done, std::size_t of)> encoded{};  // pictures
  std::function<void(const std::string& line)> note{};              // about what the video is other than expected
  Bounds bounds{};
};

// What can be known before there is a picture: throws Failure where the form makes no sense, ffmpeg is missing or lacks
// the encoder, the file cannot be written, or the audio has no sound.
void check_order(const Order& order);

// Throws Failure as check_order(), and where ffmpeg fails; then the file is as it was.
void write_video(const Source& source, const Order& order, const Listener& listener);

// The folder of pieces of a video.
std::filesystem::path pieces_folder(const std::filesystem::path& file);

}  // namespace mars::videos
