#include "host/content/importer/apart.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <new>
#include <optional>
#include <vector>

#include "hal/failure/explain.h"
#include "hal/failure/failure.h"
#include "host/child/descriptor.h"
#include "host/child/process.h"

namespace mars::importer {
namespace {

// Exit codes of the process, apart from those that others give (a sanitizer, 1).
constexpr int kHasFailed = 3;
constexpr int kHasNoMemory = 4;

// A failure's three texts, each ended by a zero.
std::string packed(const Failure& failure) {
  return failure.problem + '\0' + failure.where + '\0' + failure.remedy + '\0';
}

// Of exceptions that name no place, at `where`.
Failure unpacked(const std::string& text, const std::string& where) {
  std::array<std::string, 3> parts;
  std::size_t at = 0;
  for (std::string& part : parts) {
    part = text.c_str() + std::min(at, text.size());
    at += part.size() + 1;
  }
  return {parts[0], parts[1].empty() ? where : parts[1], parts[2]};
}

// What libraries print before they abort says nothing to people. Reports of sanitizers do.
void silence_libraries() {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere >= 0) dup2(nowhere, STDERR_FILENO);
#endif
}

// In the new process: its exit code.
int answered(const std::function<std::vector<std::string>()>& work, const child::Descriptor& answer) {
  silence_libraries();
  int code = 0;
  std::vector<std::string> parts;
  try {
    parts = work();
  } catch (const Failure& failure) {
    code = kHasFailed;
    parts = {packed(failure)};
  } catch (const std::bad_alloc&) {
    return kHasNoMemory;
  } catch (const std::exception& failure) {
    code = kHasFailed;
    parts = {packed({reason_of(failure), "", ""})};
  }
  for (const std::string& part : parts) child::write_all(answer, part);
  return code;
}

bool ready_before(std::chrono::steady_clock::time_point end, int descriptor) {
  for (;;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
    pollfd wanted{descriptor, POLLIN, 0};
    const int ready = poll(&wanted, 1, static_cast<int>(std::max<std::int64_t>(left.count(), 0)));
    if (ready >= 0 || errno != EINTR) return ready > 0;
  }
}

// All that is written until the writer closes; none where that takes longer than `time`.
std::optional<std::string> read_within(std::chrono::milliseconds time, const child::Descriptor& answer) {
  const auto end = std::chrono::steady_clock::now() + time;
  std::string text;
  std::vector<char> piece(1 << 16);
  while (ready_before(end, answer.number())) {
    const ssize_t count = read(answer.number(), piece.data(), piece.size());
    if (count == 0) return text;
    if (count > 0) text.append(piece.data(), static_cast<std::size_t>(count));
    if (count < 0 && errno != EINTR) break;
  }
  return std::nullopt;
}

std::string mebibytes(std::uint64_t bytes) { return std::to_string(bytes >> 20) + " MiB"; }

std::string seconds(std::chrono::seconds time) { return std::to_string(time.count()) + " s"; }

// Why a process without an answer ended so.
std::string reason_of(const child::Ending& ending, bool too_late, const ApartLimits& limits) {
  if (too_late) return "takes more than " + seconds(std::chrono::ceil<std::chrono::seconds>(limits.time)) + " to read";
  if (ending.signal == SIGXCPU)
    return "takes more than " + seconds(limits.processor_time) + " of processor time to read";
  if (ending.code == kHasNoMemory) return "takes more than " + mebibytes(limits.memory) + " of memory to read";
  if (ending.signal != 0) return "cannot be read: its reader crashed";
  return "cannot be read: its reader ended with code " + std::to_string(ending.code);
}

}  // namespace

ApartLimits limits_for(std::uint64_t bytes) {
  const std::chrono::seconds processor_time(5 + (bytes >> 20));
  return {processor_time, processor_time + std::chrono::minutes(1), (std::uint64_t{1} << 30) + 64 * bytes};
}

std::string run_apart(const std::function<std::vector<std::string>()>& work, const ApartLimits& limits,
                      const std::string& where, const std::string& remedy) {
  child::Pipe pipe = child::make_pipe();
  child::Process process(
      [&] { return answered(work, pipe.writing); },
      {.signal_at_our_end = SIGKILL, .limits = child::ProcessLimits{limits.processor_time, limits.memory}});
  pipe.writing.close();
  std::optional<std::string> answer = read_within(limits.time, pipe.reading);
  if (!answer) process.send(SIGKILL);
  const child::Ending ending = process.wait();
  if (answer && ending.well()) return std::move(*answer);
  if (answer && ending.code == kHasFailed) throw unpacked(*answer, where);
  throw Failure(reason_of(ending, !answer, limits), where, remedy);
}

}  // namespace mars::importer
