#include "host/videos/ffmpeg.h"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>

#include "host/child/environment.h"
#include "host/child/programs.h"
#include "host/content/document/file_failure.h"
#include "host/content/document/text.h"
#include "host/content/document/whole_file.h"

namespace mars::videos {
namespace {

constexpr std::chrono::milliseconds kLook{100};
constexpr std::chrono::milliseconds kFirstLook{2};  // most runs that are not fed are short

// What processors did for a process, which changes while it works; "" once it is gone.
std::string work_of(pid_t process) {
  std::string work;
  std::ifstream stat("/proc/" + std::to_string(process) + "/stat");
  std::string field;
  while (stat >> field && !field.ends_with(')')) continue;  // its number and its name
  for (int i = 0; i < 13 && stat >> field; ++i)
    if (i >= 11) work += field + " ";  // utime and stime
  return work;
}

constexpr std::array kNoRoom{ENOSPC, EDQUOT};
constexpr std::array kCannotWrite{ENOSPC, EDQUOT, EROFS, EACCES, EIO, EFBIG};

// ffmpeg says why a file cannot be written in the system's words.
void fail_as_file(const std::string& reason, const std::filesystem::path& file, std::span<const int> errors) {
  for (const int error : errors)
    if (reason.find(std::strerror(error)) != std::string::npos) document::fail_file("write", file, error);
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace

std::string find_ffmpeg(const std::filesystem::path& file, const std::string& name) {
  const auto program = child::find_program(name, child::program_path(child::own_environment()));
  if (!program)
    throw Failure("needs the program " + name + ", which is not installed", file.string(),
                  "install it (Debian: apt install ffmpeg), or render frames: -o DIR");
  return program->string();
}

std::string choose_encoder(const std::filesystem::path& file, std::span<const std::string_view> encoders) {
  const std::string program = find_ffmpeg(file);
  static const std::string list = run_ffmpeg(program, {"-v", "error", "-encoders"}, file, {});
  for (const std::string_view encoder : encoders)
    if (list.find(" " + std::string(encoder) + " ") != std::string::npos) return std::string(encoder);
  throw Failure("the ffmpeg that is installed has no encoder " + document::joined(encoders, " or "), file.string(),
                "install one that has it (" + program + " -encoders lists them), or choose another --codec");
}

std::string file_word(const std::filesystem::path& file) { return "file:" + std::filesystem::absolute(file).string(); }

// MARS ignores SIGXFSZ; ffmpeg, which would cut the video short without a word, must die of it.
Ffmpeg::Ffmpeg(const std::string& program, const std::vector<std::string>& words, std::filesystem::path file,
               Bounds bounds, std::string_view more)
    : file_(std::move(file)), bounds_(std::move(bounds)) {
  int ends[2] = {-1, -1};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw Failure(std::strerror(errno), "starting ffmpeg", "");
  input_ = child::Descriptor(ends[0]);
  const child::Descriptor its_input(ends[1]), its_more = child::file_in_memory(more);
  const child::ProcessSetup setup{
      .streams = {{0, its_input.number()}, {1, printed_.number()}, {2, errors_.number()}, {3, its_more.number()}},
      .signal_at_our_end = SIGKILL,
      .default_signals = {SIGXFSZ}};
  child::Command command{{{"SVT_LOG", "1"}}, {program}};  // of SVT-AV1 only what is wrong
  command.words.insert(command.words.end(), words.begin(), words.end());
  process_.emplace(command, setup);
}

void Ffmpeg::feed(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    pollfd room{input_.number(), POLLOUT, 0};
    if (poll(&room, 1, static_cast<int>(kLook.count())) == 0) {
      look();
      continue;
    }
    const ssize_t done = send(input_.number(), bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (done < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (done < 0) fail();
    bytes = bytes.subspan(static_cast<std::size_t>(done));
    note_work();
  }
}

void Ffmpeg::note_work() {
  if (said_ && bounds_.warn) bounds_.warn("ffmpeg works again");
  said_ = false;
  idle_ = std::chrono::milliseconds(0);
}

// After kLook in which nothing came of it.
void Ffmpeg::look() {
  std::string work = work_of(process_->id());
  if (work != work_) {
    work_ = std::move(work);
    return note_work();
  }
  idle_ += kLook;
  const auto seconds = std::chrono::ceil<std::chrono::seconds>(idle_).count();
  const std::string problem =
      "ffmpeg has done nothing for " + document::counted(static_cast<std::uint64_t>(seconds), "second");
  if (idle_ >= bounds_.longest)
    throw Failure(problem, file_.string(),
                  "see whether it was stopped, or its disk does not answer; the same command goes on");
  if (idle_ < bounds_.silence || said_) return;
  said_ = true;
  if (bounds_.warn) bounds_.warn(file_.string() + ": " + problem + ": is it stopped, or storage slow?");
}

void Ffmpeg::finish() {
  close_input();
  std::optional<child::Ending> ending;
  for (std::chrono::milliseconds pause = kFirstLook; !(ending = process_->poll());) {
    poll(nullptr, 0, static_cast<int>(pause.count()));
    if (pause == kLook) look();
    pause = std::min(2 * pause, kLook);
  }
  if (ending->signal == SIGXFSZ) document::fail_file("write", file_, EFBIG);
  if (ending->signal != 0)
    throw Failure("ffmpeg was killed by signal " + std::to_string(ending->signal) + " (" + strsignal(ending->signal) +
                      ")",
                  file_.string(), "see whether memory ran out; the same command goes on");
  if (!ending->well()) fail();
  fail_as_file(complaints(), file_, kNoRoom);  // ffmpeg may say this and yet end well
}

// It has ended, or closed its input.
void Ffmpeg::fail() {
  if (input_.open()) {
    close_input();
    finish();
  }
  const std::string reason = child::content_of(errors_);
  fail_as_file(reason, file_, kCannotWrite);
  throw FfmpegRefusal("ffmpeg ended without a video" + (reason.empty() ? "" : ": " + first_line(reason)),
                      file_.string(), "see whether it can write such files: ffmpeg -formats, ffmpeg -encoders");
}

std::string run_ffmpeg(const std::string& program, const std::vector<std::string>& words,
                       const std::filesystem::path& file, const Bounds& bounds) {
  Ffmpeg ffmpeg(program, words, file, bounds);
  ffmpeg.finish();
  return ffmpeg.printed();
}

}  // namespace mars::videos
