// What ffprobe finds in a file of video or audio.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace mars::videos {

struct Probed {
  struct Video {
    std::string codec;
    std::uint32_t width = 0, height = 0;
    double rate = 0;            // pictures a second, on average
    std::uint64_t packets = 0;  // pictures, as they are stored
  };
  std::optional<Video> video;
  std::string audio;    // its codec; "": there is none
  std::string comment;  // "": none
};

// Reads all of the file, but decodes nothing. Throws Failure where it is missing, or no file that ffmpeg knows, or
// where ffprobe is killed or does not answer.
Probed probe(const std::filesystem::path& file);

// Throws Failure, which names `file`, unless `part` of it has as many pictures.
void require_pictures(const std::filesystem::path& part, const std::filesystem::path& file, std::uint64_t count);

// The same for at least one.
void require_some_picture(const std::filesystem::path& part, const std::filesystem::path& file);

// As probe(), but these do not read all: whether it has audio, and its comment, also "" where it is no such file.
std::string comment_of(const std::filesystem::path& file);
bool has_audio(const std::filesystem::path& file);

}  // namespace mars::videos
