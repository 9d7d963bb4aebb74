// Counts what a FileSink would do for frames, without files: for simulations, in which files are work of a machine that
// is not there.
#pragma once

#include "host/images/picture_bands.h"
#include "host/render/sinks/frame_encoder.h"
#include "host/render/sinks/sink.h"

namespace mars::sinks {

class CountedFiles : public Sink {
 public:
  // `part`: of the bytes of a picture's pixels, those that its file has. From one thread.
  CountedFiles(const images::PictureBands& bands, double part);

  void take(compositor::Frame& frame) override;
  bool restores() const override { return true; }
  images::FileWork made() const override { return made_; }

 private:
  FrameEncoder encoder_;
  const std::uint64_t file_bytes_;  // of a file
  images::FileWork made_;
};

}  // namespace mars::sinks
