// Videos by the program ffmpeg, an optional companion: pictures go in as raw pixels, the finished file comes back
// through memory and appears whole or not at all.
#pragma once

#include <filesystem>
#include <optional>

#include "host/child/descriptor.h"
#include "host/child/process.h"
#include "host/preview/pictures.h"

namespace mars::preview {

class Video {
 public:
  // Of `rate` pictures a second. The file's ending says which kind: .gif or .mp4. Throws Failure where ffmpeg is
  // missing or the file cannot be written.
  Video(std::filesystem::path path, images::PictureSize extent, double rate);
  ~Video() = default;  // a video that is not finished is not written
  Video(const Video&) = delete;
  Video& operator=(const Video&) = delete;

  void add(const images::Image& image);
  void finish();

 private:
  void start(images::PictureSize extent, double rate);
  [[noreturn]] void fail();

  std::filesystem::path path_;
  child::Descriptor input_;  // of a socket: where its reader is gone, writing is an error and no signal
  child::Descriptor output_ = child::file_in_memory();
  child::Descriptor errors_ = child::file_in_memory();
  std::optional<child::Process> process_;
};

}  // namespace mars::preview
