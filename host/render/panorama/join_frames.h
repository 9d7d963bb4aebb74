// Frames of a panorama, joined of the frames of its film of faces, which are EXR files of a folder: several at a time,
// as the machine has processors and memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "node/wire/film.h"
#include "node/wire/pixel_format.h"
#include "host/render/sinks/frame_folder.h"

namespace mars::panorama {

struct Joining {
  const wire::PackedFilm& panorama;
  std::filesystem::path faces;        // the folder of faces
  sinks::FrameFolder& folder;         // takes the joined frames
  std::vector<std::uint32_t> frames;  // of the panorama
  std::uint32_t processors = 1;
  std::uint64_t memory = 0;  // bytes that it may take, but for what one frame takes
};

// The memory that joining one frame of these pixels takes; a face has `side` pixels a side.
std::uint64_t joining_bytes(std::uint32_t side, wire::PixelFormat pixels);

// `joined` is called with the number of frames that are done, from several threads, one at a time. Throws
// sinks::DamagedFrame where a face is missing or torn, and Failure where a frame cannot be written.
void join_frames(const Joining& joining, const std::function<void(std::size_t done)>& joined);

}  // namespace mars::panorama
