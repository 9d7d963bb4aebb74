#include "host/preview/video.h"

#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <string>
#include <vector>

#include "hal/failure/failure.h"
#include "host/content/document/whole_file.h"

namespace mars::host {
namespace {

constexpr int kOutput = 3;  // of ffmpeg

std::vector<std::string> command(bool gif, PictureSize extent, double rate) {
  std::array<char, 40> number{};
  std::to_chars(number.data(), number.data() + number.size() - 1, rate);
  std::vector<std::string> words{"ffmpeg", "-v", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgb0", "-s",
                                 std::to_string(extent.width) + "x" + std::to_string(extent.height), "-r",
                                 number.data(), "-i", "-"};
  const std::vector<std::string> ending =
      gif ? std::vector<std::string>{"-filter_complex",
                                     "split[a][b];[a]palettegen=stats_mode=diff[p];[b][p]paletteuse=dither=none",
                                     "-f", "gif"}
          // What every player takes: even sides, colours at half the resolution, the index in front.
          : std::vector<std::string>{"-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p", "-movflags",
                                     "+faststart", "-f", "mp4"};
  words.insert(words.end(), ending.begin(), ending.end());
  words.push_back("/proc/self/fd/" + std::to_string(kOutput));
  return words;
}

std::string content_of(int file) {
  std::string bytes(static_cast<std::size_t>(lseek(file, 0, SEEK_END)), '\0');
  std::size_t used = 0;
  while (used < bytes.size()) {
    const ssize_t done = pread(file, bytes.data() + used, bytes.size() - used, static_cast<off_t>(used));
    if (done <= 0) break;
    used += static_cast<std::size_t>(done);
  }
  bytes.resize(used);
  return bytes;
}

}  // namespace

Video::Video(std::filesystem::path path, PictureSize extent, double rate) : path_(std::move(path)) {
  check_can_write(path_);  // better now than after the last frame
  try {
    start(extent, rate);
  } catch (...) {
    end();
    throw;
  }
}

void Video::start(PictureSize extent, double rate) {
  output_ = memfd_create("video", MFD_CLOEXEC);
  errors_ = memfd_create("errors", MFD_CLOEXEC);
  int ends[2] = {-1, -1};
  if (output_ < 0 || errors_ < 0 || socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw Failure(std::strerror(errno), "starting ffmpeg", "");
  input_ = ends[0];
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], 0);
  posix_spawn_file_actions_adddup2(&actions, errors_, 1);
  posix_spawn_file_actions_adddup2(&actions, errors_, 2);
  posix_spawn_file_actions_adddup2(&actions, output_, kOutput);
  std::vector<std::string> words = command(path_.extension() == ".gif", extent, rate);
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  // MARS ignores this signal; ffmpeg, which would cut the video short without a word, must die of it.
  sigset_t defaults;
  sigemptyset(&defaults);
  sigaddset(&defaults, SIGXFSZ);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setsigdefault(&attributes, &defaults);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  const int error = posix_spawnp(&process_, "ffmpeg", &actions, &attributes, pointers.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  if (error == 0) return;
  process_ = -1;
  throw Failure(std::string("needs the program ffmpeg, which cannot be started: ") + std::strerror(error),
                path_.string(), "install it (Debian: apt install ffmpeg), or write a contact sheet: -o sheet.png");
}

void Video::add(const Image& image) {
  const auto* next = reinterpret_cast<const char*>(image.pixels.data());
  std::size_t left = image.pixels.size() * sizeof(std::uint32_t);
  while (left > 0) {
    const ssize_t done = send(input_, next, left, MSG_NOSIGNAL);
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) fail();
    next += done;
    left -= static_cast<std::size_t>(done);
  }
}

void Video::finish() {
  close(input_);
  input_ = -1;
  int status = 0;
  while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXFSZ) fail_file("write", path_, EFBIG);
  if (status != 0) fail();
  write_whole_file(path_, content_of(output_));
}

void Video::fail() {
  const std::string told = content_of(errors_);
  throw Failure("ffmpeg ended without a video" + (told.empty() ? "" : ": " + told.substr(0, told.find('\n'))),
                path_.string(), "see whether it can write such files: ffmpeg -formats, ffmpeg -encoders");
}

void Video::end() {
  for (const int descriptor : {input_, output_, errors_})
    if (descriptor >= 0) close(descriptor);
  if (process_ > 0) {
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
}

Video::~Video() { end(); }

}  // namespace mars::host
