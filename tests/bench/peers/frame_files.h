// Encodes and writes frames on threads of its own while others are drawn, for a competitor that writes files. Like
// MARS, it has as many threads as processors, but two at least, and two buffers more; and it flushes each file to the
// disk.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "tests/bench/peers/png_encoder.h"

namespace mars::bench {

struct FrameBuffer {
  std::vector<std::uint32_t> pixels;
  std::uint32_t number = 0;
};

class FrameFiles {
 public:
  // Files frame-0000.png and so on of `folder`.
  FrameFiles(std::string folder, const std::string& encoder, std::uint32_t width, std::uint32_t height);
  ~FrameFiles();
  FrameFiles(const FrameFiles&) = delete;
  FrameFiles& operator=(const FrameFiles&) = delete;

  std::vector<FrameBuffer>& buffers() { return buffers_; }
  // The number of a buffer whose file is written. Throws what a thread has thrown.
  std::size_t free_buffer();
  void submit(std::size_t buffer);
  // Until all files are written and closed.
  void finish();

 private:
  void work();
  void write(PngEncoder& encoder, const FrameBuffer& frame) const;

  const std::string folder_, encoder_;
  const std::uint32_t width_, height_;
  std::vector<FrameBuffer> buffers_;
  std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  std::vector<std::size_t> free_;
  std::deque<std::size_t> waiting_;
  std::exception_ptr failure_;
  bool stop_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace mars::bench
