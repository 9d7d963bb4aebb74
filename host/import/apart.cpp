#include "host/import/apart.h"

#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

namespace mars::host {
namespace {

constexpr int kFailed = 1;

void write_all(int descriptor, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t written = write(descriptor, text.data() + done, text.size() - done);
    if (written < 0 && errno != EINTR) return;
    if (written > 0) done += static_cast<std::size_t>(written);
  }
}

std::string read_all(int descriptor) {
  std::string text;
  std::array<char, 4096> piece;
  for (;;) {
    const ssize_t count = read(descriptor, piece.data(), piece.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return text;
    text.append(piece.data(), static_cast<std::size_t>(count));
  }
}

// A failure's three texts, each ended by a zero.
std::string packed(const Failure& failure) {
  return failure.problem + '\0' + failure.where + '\0' + failure.remedy + '\0';
}

Failure unpacked(const std::string& text) {
  std::array<std::string, 3> parts;
  std::size_t at = 0;
  for (std::string& part : parts) {
    part = text.c_str() + std::min(at, text.size());
    at += part.size() + 1;
  }
  return {parts[0], parts[1], parts[2]};
}

// In the new process.
[[noreturn]] void run(const std::function<std::string()>& work, rlim_t seconds, int answer) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const rlimit none{0, 0}, time{seconds, seconds};
  setrlimit(RLIMIT_CORE, &none);
  setrlimit(RLIMIT_CPU, &time);
  int code = 0;
  std::string text;
  try {
    text = work();
  } catch (const Failure& failure) {
    code = kFailed;
    text = packed(failure);
  } catch (const std::exception& failure) {
    code = kFailed;
    text = packed({reason_of(failure), "", ""});
  }
  write_all(answer, text);
  _exit(code);
}

}  // namespace

std::string run_apart(const std::function<std::string()>& work, std::chrono::seconds most, const Failure& lost) {
  int ends[2];
  if (pipe(ends) != 0) throw Failure(std::strerror(errno), "starting a process", "");
  const pid_t process = fork();
  if (process == 0) run(work, static_cast<rlim_t>(most.count()), ends[1]);
  const int error = errno;
  close(ends[1]);
  const std::string answer = process > 0 ? read_all(ends[0]) : "";
  close(ends[0]);
  if (process < 0) throw Failure(std::strerror(error), "starting a process", "");
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status)) throw lost;
  if (WEXITSTATUS(status) != 0) throw unpacked(answer);
  return answer;
}

}  // namespace mars::host
