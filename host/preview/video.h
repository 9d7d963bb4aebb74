// Videos by the program ffmpeg, an optional companion: pictures go in as raw pixels, the finished file comes back
// through memory and appears whole or not at all.
#pragma once

#include <sys/types.h>

#include <filesystem>

#include "host/preview/pictures.h"

namespace mars::host {

class Video {
 public:
  // Of `rate` pictures a second. The file's ending says which kind: .gif or .mp4. Throws Failure where ffmpeg is
  // missing or the file cannot be written.
  Video(std::filesystem::path path, PictureSize extent, double rate);
  ~Video();
  Video(const Video&) = delete;
  Video& operator=(const Video&) = delete;

  void add(const Image& image);
  void finish();

 private:
  void start(PictureSize extent, double rate);
  void end();
  [[noreturn]] void fail();

  std::filesystem::path path_;
  pid_t process_ = -1;
  int input_ = -1;   // ours, of a socket: who writes to one whose reader is gone gets an error, not a signal
  int output_ = -1;  // files in memory
  int errors_ = -1;
};

}  // namespace mars::host
