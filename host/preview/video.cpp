#include "host/preview/video.h"

#include <sys/socket.h>

#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <string>
#include <vector>

#include "hal/failure/failure.h"
#include "host/child/environment.h"
#include "host/child/programs.h"
#include "host/content/document/whole_file.h"

namespace mars::preview {
namespace {

constexpr int kOutput = 3;  // of ffmpeg

child::Command command(const std::string& program, bool gif, images::PictureSize extent, double rate) {
  std::array<char, 40> number{};
  std::to_chars(number.data(), number.data() + number.size() - 1, rate);
  std::vector<std::string> words{
      program,    "-v",          "error", "-y", "-f",
      "rawvideo", "-pix_fmt",    "rgb0",  "-s", std::to_string(extent.width) + "x" + std::to_string(extent.height),
      "-r",       number.data(), "-i",    "-"};
  const std::vector<std::string> ending =
      gif ? std::vector<std::string>{"-filter_complex",
                                     "split[a][b];[a]palettegen=stats_mode=diff[p];[b][p]paletteuse=dither=none", "-f",
                                     "gif"}
          // What every player takes: even sides, colours at half the resolution, the index in front.
          : std::vector<std::string>{
                "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p", "-movflags", "+faststart", "-f", "mp4"};
  words.insert(words.end(), ending.begin(), ending.end());
  words.push_back("/proc/self/fd/" + std::to_string(kOutput));
  return {{}, words};
}

}  // namespace

Video::Video(std::filesystem::path path, images::PictureSize extent, double rate) : path_(std::move(path)) {
  document::check_can_write(path_);  // better now than after the last frame
  start(extent, rate);
}

void Video::start(images::PictureSize extent, double rate) {
  const auto program = child::find_program("ffmpeg", child::program_path(child::own_environment()));
  if (!program)
    throw Failure("needs the program ffmpeg, which is not installed", path_.string(),
                  "install it (Debian: apt install ffmpeg), or write a contact sheet: -o sheet.png");
  int ends[2] = {-1, -1};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw Failure(std::strerror(errno), "starting ffmpeg", "");
  input_ = child::Descriptor(ends[0]);
  const child::Descriptor its_input(ends[1]);
  // MARS ignores SIGXFSZ; ffmpeg, which would cut the video short without a word, must die of it.
  const child::ProcessSetup setup{
      .streams = {{0, its_input.number()}, {1, errors_.number()}, {2, errors_.number()}, {kOutput, output_.number()}},
      .default_signals = {SIGXFSZ}};
  process_.emplace(command(program->string(), path_.extension() == ".gif", extent, rate), setup);
}

void Video::add(const images::Image& image) {
  const auto* next = reinterpret_cast<const char*>(image.pixels.data());
  std::size_t left = image.pixels.size() * sizeof(std::uint32_t);
  while (left > 0) {
    const ssize_t done = send(input_.number(), next, left, MSG_NOSIGNAL);
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) fail();
    next += done;
    left -= static_cast<std::size_t>(done);
  }
}

void Video::finish() {
  input_.close();
  const child::Ending ending = process_->wait();
  if (ending.signal == SIGXFSZ) document::fail_file("write", path_, EFBIG);
  if (!ending.well()) fail();
  document::write_whole_file(path_, child::content_of(output_));
}

void Video::fail() {
  const std::string reason = child::content_of(errors_);
  throw Failure("ffmpeg ended without a video" + (reason.empty() ? "" : ": " + reason.substr(0, reason.find('\n'))),
                path_.string(), "see whether it can write such files: ffmpeg -formats, ffmpeg -encoders");
}

}  // namespace mars::preview
