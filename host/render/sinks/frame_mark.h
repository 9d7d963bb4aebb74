// What a frame's file says of itself, as one line of JSON beside its pixels (host/images/picture_file.h): which frame
// of which film it is, and the hash of its pixels. From it a folder's manifest can be made again (restore.h). The same
// for the same frame of the same film, so that files stay the same byte for byte.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "host/images/picture_bands.h"
#include "host/render/sinks/manifest.h"

namespace mars::sinks {

struct FrameMark {
  std::string film;     // checksum of the compiled film
  std::string content;  // of what decides this frame's pixels (frame_content.h); "": not known
  std::uint32_t frame = 0;
  std::uint32_t film_frames = 0;  // of the whole film
  double rate = 0;                // frames a second
  FrameForm form{};
  images::PicturePlace place{};
  std::uint32_t pixel_version = wire::kPixelVersion;
  std::string pixel_hash;

  bool operator==(const FrameMark&) const = default;
};

std::string text_of(const FrameMark& mark);
// None where it is no such text.
std::optional<FrameMark> mark_of(const std::string& text);
// Of a file; none where it has none, as those of the first pixel version, or is none.
std::optional<FrameMark> read_mark(const std::filesystem::path& file);

// Whether the file has a frame's name: the usual one of some frame, or the one that its mark says. Others may be copies
// that somebody made.
bool is_named_as_frame(const std::string& file_name, const std::optional<FrameMark>& mark);

// Whether a frame may be there: a regular file, links followed, with something in it. Opens nothing.
// Throws Failure where that cannot be seen.
bool is_frame_file(const std::filesystem::path& file);

// Of a frame of the manifest's folder.
FrameMark mark_in(const Manifest& manifest, std::uint32_t frame, const std::string& pixel_hash,
                  const std::string& content);
// What its file says of it.
images::FileFacts facts_in(const Manifest& manifest, std::uint32_t frame, const std::string& pixel_hash,
                           const std::string& content);

}  // namespace mars::sinks
