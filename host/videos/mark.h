// What a video's file says of itself, as one line of JSON in its comment: which frames of which film it shows, and how
// it was made. mars verify compares it with the file; mars render sees from it that a video is there already. GIF and
// APNG files have none: ffmpeg writes no comment there.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace mars::videos {

struct Mark {
  std::string film;                   // its file's name, without its folder
  std::string recipe;                 // checksum of all that decides the file's content; "": not known
  std::vector<std::uint32_t> frames;  // of the film, ascending
  std::uint32_t film_frames = 0;      // of the whole film
  double rate = 0;                    // frames a second
  std::uint32_t width = 0, height = 0;

  bool operator==(const Mark&) const = default;
};

std::string text_of(const Mark& mark);
// Whether it is one of any version: MARS has made the file.
bool is_mark(const std::string& text);
// None where it is no such text.
std::optional<Mark> mark_of(const std::string& text);

}  // namespace mars::videos
