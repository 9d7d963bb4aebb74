// The program ffmpeg, which MARS starts to encode, join and check videos. It runs until its work is done; where it does
// nothing any more, because somebody has stopped it or storage does not answer, a warning says so, and after a while it
// is killed: nothing waits for it for ever.
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hal/failure/failure.h"
#include "host/child/descriptor.h"
#include "host/child/process.h"

namespace mars::videos {

// Its path. Throws Failure, with `file` as the place, where it is not installed. `name`: ffmpeg or ffprobe.
std::string find_ffmpeg(const std::filesystem::path& file, const std::string& name = "ffmpeg");

// The first of `encoders` that it has. Throws Failure where it has none.
std::string choose_encoder(const std::filesystem::path& file, std::span<const std::string_view> encoders);

// It ended by itself, and not well.
class FfmpegRefusal : public Failure {
 public:
  using Failure::Failure;
};

// How ffmpeg is given a file: no name is taken for an option, a pattern or an address.
std::string file_word(const std::filesystem::path& file);

// Time counts as it is observed: of a process that is stopped itself meanwhile, a look at most.
struct Bounds {
  std::function<void(const std::string& line)> warn{};           // none: no warnings
  std::chrono::milliseconds silence = std::chrono::seconds(10);  // of an ffmpeg that does nothing, until warn()
  std::chrono::milliseconds longest = std::chrono::minutes(10);  // until it is killed
};

class Ffmpeg {
 public:
  // `words`: behind the program's name. `file` is what failures name. It reads standard input if it is fed; what it
  // prints is in printed(). `more`: what it can read from its descriptor 3.
  Ffmpeg(const std::string& program, const std::vector<std::string>& words, std::filesystem::path file, Bounds bounds,
         std::string_view more = "");
  Ffmpeg(const Ffmpeg&) = delete;
  Ffmpeg& operator=(const Ffmpeg&) = delete;
  ~Ffmpeg() = default;  // kills it where it runs still

  // Throws Failure where it has ended, or does nothing any more.
  void feed(std::span<const std::byte> bytes);
  // Nothing more comes. Throws Failure unless it ends well.
  void finish();
  // After finish().
  std::string printed() const { return child::content_of(printed_); }
  std::string complaints() const { return child::content_of(errors_); }

 private:
  void look();
  void note_work();
  void close_input() { input_.close(); }
  [[noreturn]] void fail();

  const std::filesystem::path file_;
  const Bounds bounds_;
  child::Descriptor input_;  // of a socket: where its reader is gone, writing is an error and no signal
  child::Descriptor printed_ = child::file_in_memory();
  child::Descriptor errors_ = child::file_in_memory();
  std::optional<child::Process> process_;
  std::string work_;  // what the system counted for it when it was looked at last
  std::chrono::milliseconds idle_{0};
  bool said_ = false;
};

// Runs it to its end; what it printed.
std::string run_ffmpeg(const std::string& program, const std::vector<std::string>& words,
                       const std::filesystem::path& file, const Bounds& bounds);

}  // namespace mars::videos
