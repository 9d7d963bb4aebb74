// Names of the files of numbered frames, without their endings: "shot_####", as Blender writes it, where # is a digit,
// or "shot_%04d", as C's printf does. A number of more digits has them all.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <string>

namespace mars::images {

inline constexpr std::uint32_t kMostFirstNumber = 1'000'000'000;

struct FrameNames {
  std::string pattern;             // with #; "": frame-####, with as many digits as the film's last frame needs
  std::uint32_t first_number = 0;  // of frame 0

  auto operator<=>(const FrameNames&) const = default;
};

// `text` with # for the number, which is added where it has none. Throws Failure, which says what is wrong with it.
std::string frame_pattern(const std::string& text);
// Whether the text has a place for a number.
bool has_number(const std::string& text);

// Of a frame of a film of `film_frames`; without ending.
std::string frame_name(const FrameNames& names, std::uint32_t frame, std::uint32_t film_frames);
// Whose name it is; none where it is no frame's.
std::optional<std::uint32_t> frame_of_name(const FrameNames& names, const std::string& name, std::uint32_t film_frames);

}  // namespace mars::images
