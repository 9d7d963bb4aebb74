#include "host/content/importer/apart.h"

#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <new>
#include <optional>
#include <vector>

#include "hal/failure/explain.h"
#include "hal/failure/failure.h"
#include "topology/memory_limit.h"

namespace mars::host {
namespace {

// Exit codes of the process, apart from those that others give (a sanitizer, 1).
constexpr int kHasFailed = 3;
constexpr int kHasNoMemory = 4;

void write_all(int descriptor, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t written = write(descriptor, text.data() + done, text.size() - done);
    if (written < 0 && errno != EINTR) return;
    if (written > 0) done += static_cast<std::size_t>(written);
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

void limit(int resource, std::uint64_t most) {
  rlimit now{};
  getrlimit(static_cast<__rlimit_resource>(resource), &now);
  now.rlim_cur = std::min<rlim_t>({now.rlim_cur, now.rlim_max, most});
  setrlimit(static_cast<__rlimit_resource>(resource), &now);
}

// In the new process.
[[noreturn]] void run(const std::function<std::string()>& work, const ApartLimits& limits, pid_t parent, int answer) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(kHasFailed);  // it ended before
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, static_cast<std::uint64_t>(limits.processor_time.count()));
  limit(RLIMIT_AS, topology::process_memory().addresses + limits.memory);
  int code = 0;
  std::string text;
  try {
    text = work();
  } catch (const Failure& failure) {
    code = kHasFailed;
    text = packed(failure);
  } catch (const std::bad_alloc&) {
    _exit(kHasNoMemory);
  } catch (const std::exception& failure) {
    code = kHasFailed;
    text = packed({reason_of(failure), "", ""});
  }
  write_all(answer, text);
  _exit(code);
}

// A started process and the answer that it writes. Its end is waited for.
class Apart {
 public:
  Apart(const std::function<std::string()>& work, const ApartLimits& limits) : limits_(limits) {
    int ends[2];
    if (pipe(ends) != 0) throw Failure(std::strerror(errno), "starting a process", "");
    const pid_t parent = getpid();
    process_ = fork();
    if (process_ == 0) run(work, limits, parent, ends[1]);
    const int error = errno;
    close(ends[1]);
    answer_ = ends[0];
    if (process_ > 0) return;
    close(answer_);
    throw Failure(std::strerror(error), "starting a process", "");
  }
  ~Apart() { close(answer_); }
  Apart(const Apart&) = delete;
  Apart& operator=(const Apart&) = delete;

  // None where the process is not done in time: it is ended then. Its memory's limit is the answer's too.
  std::optional<std::string> answer() {
    const auto end = std::chrono::steady_clock::now() + limits_.time;
    std::string text;
    std::vector<char> piece(1 << 16);
    while (is_ready(end)) {
      const ssize_t count = read(answer_, piece.data(), piece.size());
      if (count == 0) return text;
      if (count > 0) text.append(piece.data(), static_cast<std::size_t>(count));
      if (count < 0 && errno != EINTR) break;
    }
    kill(process_, SIGKILL);
    return std::nullopt;
  }

  // As waitpid() tells it.
  int end() const {
    int status = 0;
    while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
  }

 private:
  bool is_ready(std::chrono::steady_clock::time_point end) const {
    for (;;) {
      const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
      pollfd wanted{answer_, POLLIN, 0};
      const int ready = poll(&wanted, 1, static_cast<int>(std::max<std::int64_t>(left.count(), 0)));
      if (ready >= 0 || errno != EINTR) return ready > 0;
    }
  }

  ApartLimits limits_;
  pid_t process_ = -1;
  int answer_ = -1;
};

std::string mebibytes(std::uint64_t bytes) { return std::to_string(bytes >> 20) + " MiB"; }

std::string seconds(std::chrono::seconds time) { return std::to_string(time.count()) + " s"; }

// Why a process without an answer ended so.
std::string reason_of_end(int status, bool too_late, const ApartLimits& limits) {
  if (too_late) return "takes more than " + seconds(std::chrono::ceil<std::chrono::seconds>(limits.time)) + " to read";
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
    return "takes more than " + seconds(limits.processor_time) + " of processor time to read";
  if (WIFEXITED(status) && WEXITSTATUS(status) == kHasNoMemory)
    return "takes more than " + mebibytes(limits.memory) + " of memory to read";
  if (WIFSIGNALED(status)) return "cannot be read: its reader crashed";
  return "cannot be read: its reader ended with code " + std::to_string(WEXITSTATUS(status));
}

}  // namespace

std::string run_apart(const std::function<std::string()>& work, const ApartLimits& limits, const std::string& where,
                      const std::string& remedy) {
  Apart apart(work, limits);
  const std::optional<std::string> answer = apart.answer();
  const int status = apart.end();
  if (answer && WIFEXITED(status) && WEXITSTATUS(status) == 0) return *answer;
  if (answer && WIFEXITED(status) && WEXITSTATUS(status) == kHasFailed) throw unpacked(*answer);
  throw Failure(reason_of_end(status, !answer, limits), where, remedy);
}

}  // namespace mars::host
