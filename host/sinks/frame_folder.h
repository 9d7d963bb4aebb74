// The folder a film is rendered into: frame-0000.png and so on, and frames.json, the manifest that says
// which frames of which film belong there. The manifest is written first, so that a folder without it, or
// with fewer frames than it names, is known to be unfinished.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "host/sinks/sink.h"

namespace mars::host {

struct Manifest {
  std::string film;      // its file's name, as the person gave it
  std::string checksum;  // of the compiled film: 32 hexadecimal digits (checksum.h)
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  double rate = 0;                    // frames a second
  std::uint32_t film_frames = 0;      // of the whole film
  std::vector<std::uint32_t> frames;  // asked for, by one run or several, ascending

  bool operator==(const Manifest&) const = default;
};

class FrameFolder {
 public:
  // Creates the folder where it is missing, clears away what a killed run left, and writes the manifest; where
  // there is one of the same compiled film, its frames belong there too.
  FrameFolder(std::filesystem::path path, const Manifest& manifest);

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path file_of(std::uint32_t frame) const;

 private:
  std::filesystem::path path_;
  std::uint32_t film_frames_;
};

// Names sort as frames do: as many digits as the film's last frame needs, at least four.
std::string frame_file_name(std::uint32_t frame, std::uint32_t film_frames);

// Removes files that were being written when their process was killed.
void remove_parts(const std::filesystem::path& folder);

Manifest read_manifest(const std::filesystem::path& folder);

// Writes every frame as a PNG file of the folder.
class PngSink : public Sink {
 public:
  // `folder` must outlive the sink.
  explicit PngSink(const FrameFolder& folder) : folder_(folder) {}
  void take(const Frame& frame) override;

 private:
  const FrameFolder& folder_;
};

}  // namespace mars::host
