#include "host/shell/nx/mpi_help.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstring>
#include <optional>
#include <ostream>
#include <span>

#include "hal/failure/failure.h"
#include "host/child/descriptor.h"
#include "host/child/process.h"
#include "host/child/signal_relay.h"
#include "host/child/standard_streams.h"
#include "host/shell/launch/mpi_words.h"
#include "host/shell/launch/text_reader.h"

namespace mars::nx_jobs {
namespace {

const std::string kDashes = std::string(74, '-') + "\n";
constexpr std::size_t kPiece = 1 << 16;  // bytes: as much as a pipe holds
constexpr std::size_t kMost = 1 << 20;   // bytes that are collected while more comes
constexpr int kTick = 100;               // ms between two looks whether mpirun has ended

bool holds_one_of(std::string_view text, std::span<const std::string_view> words) {
  return std::ranges::any_of(words, [&](std::string_view each) { return text.find(each) != std::string_view::npos; });
}

// Programs write blocks of their own, also about MPI.
bool is_help(std::string_view block) {
  constexpr std::array<std::string_view, 7> kWords{"mpirun", "Open MPI",   "MPI_ABORT was invoked", "ORTE", "Open RTE",
                                                   "PMIX",   "Primary job"};
  return holds_one_of(block, kWords);
}

bool is_remark(std::string_view line) {
  constexpr std::array<std::string_view, 3> kRemarks{"sent help message help-", "orte_base_help_aggregate",
                                                     "] ORTE_ERROR_LOG: "};
  return holds_one_of(line, kRemarks);
}

// Another block or a program says why the job failed, and exit codes are the programs'.
bool says_nothing_new(std::string_view help) {
  constexpr std::array<std::string_view, 5> kEnds{
      "MPI_ABORT was invoked", "a non-zero exit code", "exited with non-zero status",
      "Error name: The specified application failed to start", "Error name: (null)"};
  return holds_one_of(help, kEnds);
}

// "process rank 2 with PID 0 on node ada exited on signal 11 (Segmentation fault)", in the words for processes.
std::optional<std::string> death_in(const std::string& help, bool has_host) {
  launch::TextReader words(help);
  const auto rank = words.find("process rank ") ? words.number() : std::nullopt;
  const auto signal = rank && words.find(" exited on signal ") ? words.number() : std::nullopt;
  if (!signal) return std::nullopt;
  const std::string name = has_host && *rank == 0 ? "the host" : "node " + std::to_string(*rank - (has_host ? 1 : 0));
  return name + " died: signal " + std::to_string(*signal) + " (" + strsignal(static_cast<int>(*signal)) + ")";
}

std::optional<Failure> failed_start_in(const std::string& help) {
  if (const auto program = launch::word_behind(help, "Executable:"))
    return Failure("there is no such program on machine " + launch::word_behind(help, "Node:").value_or("?"), *program,
                   "put it under the same path on every machine, as on a shared file system");
  if (const auto program = launch::word_behind(help, "Application name:"))
    return Failure("cannot be started on machine " + launch::word_behind(help, "Local host:").value_or("?"), *program,
                   "start it there without mars-nx to see why");
  return std::nullopt;
}

// A block of help in one line, "" where it says nothing new; none where it is not understood.
std::optional<std::string> meaning_of_block(std::string_view block, bool has_host) {
  const std::string help = launch::on_one_line(block);
  if (!is_help(help)) return std::nullopt;
  const auto line = [](const std::string& text) { return "mars-nx: " + text + "\n"; };
  if (const auto death = death_in(help, has_host)) return line(*death);
  if (const auto failure = failed_start_in(help)) return line(failure->what());
  if (const auto meaning = launch::meaning_of(help)) return line(meaning->what());
  if (says_nothing_new(help)) return "";
  return std::nullopt;
}

std::string without_remarks(std::string_view text) {
  std::string rest;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, std::min(text.find('\n'), text.size() - 1) + 1);
    if (!is_remark(line)) rest += line;
    text.remove_prefix(line.size());
  }
  return rest;
}

// False where nothing more can come. It reads all that is there, so that blocks are whole.
bool show_what_comes(const child::Descriptor& from, int longest_wait, bool has_host) {
  pollfd ready{from.number(), POLLIN, 0};
  if (poll(&ready, 1, longest_wait) <= 0) return true;
  std::string text;
  do {
    const std::size_t used = text.size();
    text.resize(used + kPiece);
    const ssize_t count = read(from.number(), text.data() + used, kPiece);
    text.resize(used + static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    if (count <= 0) break;
  } while (text.size() < kMost && poll(&ready, 1, 0) > 0);
  child::raw_error() << explained(text, has_host) << std::flush;
  return !text.empty();
}

}  // namespace

// The line of dashes that ends what is not understood may begin a block that is.
std::string explained(std::string_view text, bool has_host) {
  std::string shown;
  for (std::size_t begin; (begin = text.find(kDashes)) != std::string_view::npos;) {
    shown += without_remarks(text.substr(0, begin));
    text.remove_prefix(begin);
    const std::size_t end = text.find(kDashes, kDashes.size());
    if (end == std::string_view::npos) return shown.append(text);
    const auto meaning = meaning_of_block(text.substr(0, end), has_host);
    shown.append(meaning ? std::string_view(*meaning) : text.substr(0, end));
    text.remove_prefix(meaning ? end + kDashes.size() : end);
  }
  return shown + without_remarks(text);
}

// It stays in our process group: a terminal lets one group alone read. What holds the pipe open when mpirun has ended,
// as ssh to a machine that does not answer, is not waited for.
int run_mpirun(const child::Command& command, bool has_host) {
  child::Pipe words = child::make_pipe();
  child::SignalRelay signals;
  child::Process mpirun(command, {.streams = {{STDERR_FILENO, words.writing.number()}}, .signal_at_our_end = SIGTERM});
  signals.relay_to_member(mpirun.id());
  words.writing.close();
  std::optional<child::Ending> ending;
  while (!ending && show_what_comes(words.reading, kTick, has_host)) ending = mpirun.poll();
  if (!ending) ending = mpirun.wait();
  signals.forget_group();
  show_what_comes(words.reading, 0, has_host);
  return ending->signal != 0 ? 128 + ending->signal : ending->code;
}

}  // namespace mars::nx_jobs
