#include "host/shell/nx/mpi_help.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "hal/failure/failure.h"
#include "host/child/descriptor.h"
#include "host/child/process.h"
#include "host/shell/launch/mpi_words.h"
#include "host/shell/launch/text_reader.h"

namespace mars::nx_jobs {
namespace {

const std::string kDashes(74, '-');
constexpr std::size_t kLongestHelp = 4096;  // bytes: more is a program's own

bool holds_one_of(std::string_view text, std::span<const std::string_view> words) {
  return std::ranges::any_of(words, [&](std::string_view each) { return text.find(each) != std::string_view::npos; });
}

// A program's own table may stand between such lines of dashes.
bool is_help(std::string_view block) {
  constexpr std::array<std::string_view, 7> kWords{"mpirun",   "Open MPI", "MPI_",       "ORTE",
                                                   "Open RTE", "PMIX",     "Primary job"};
  return holds_one_of(block, kWords);
}

bool is_remark(std::string_view line) {
  constexpr std::array<std::string_view, 5> kRemarks{"sent help message help-", "orte_base_help_aggregate",
                                                     "total processes failed to start", "total processes killed",
                                                     "] ORTE_ERROR_LOG: "};
  return holds_one_of(line, kRemarks);
}

// Programs say why they give up, and exit codes are theirs.
bool says_nothing_new(std::string_view help) {
  constexpr std::array<std::string_view, 3> kEnds{"MPI_ABORT was invoked", "a non-zero exit code",
                                                  "exited with non-zero status"};
  return holds_one_of(help, kEnds);
}

std::optional<std::string> word_behind(const std::string& help, const char* words) {
  launch::TextReader reader(help);
  if (!reader.find(words)) return std::nullopt;
  reader.skip_space();
  return reader.word();
}

// "process rank 2 with PID 0 on node ada exited on signal 11 (Segmentation fault)", said as of processes.
std::optional<std::string> death_in(const std::string& help, bool has_host) {
  launch::TextReader words(help);
  const auto rank = words.find("process rank ") ? words.number() : std::nullopt;
  const auto signal = rank && words.find(" exited on signal ") ? words.number() : std::nullopt;
  if (!signal) return std::nullopt;
  const std::string name = has_host && *rank == 0 ? "the host" : "node " + std::to_string(*rank - (has_host ? 1 : 0));
  return name + " died: signal " + std::to_string(*signal) + " (" + strsignal(static_cast<int>(*signal)) + ")";
}

std::optional<Failure> failed_start_in(const std::string& help) {
  if (const auto program = word_behind(help, "Executable:"))
    return Failure("there is no such program on machine " + word_behind(help, "Node:").value_or("?"), *program,
                   "put it under the same path on every machine, as on a shared file system");
  if (const auto program = word_behind(help, "Application name:"))
    return Failure("cannot be started on machine " + word_behind(help, "Local host:").value_or("?"), *program,
                   "start it there without mars-nx to see why");
  return std::nullopt;
}

// Reads until all ends of the pipe are closed.
int filter(const child::Pipe& pipe, bool has_host) {
  MpiHelp help(has_host);
  const child::Descriptor out(STDERR_FILENO);
  std::FILE* const in = fdopen(pipe.reading.number(), "r");
  char* bytes = nullptr;
  std::size_t room = 0;
  for (ssize_t count; (count = getline(&bytes, &room, in)) > 0;) {
    std::string line(bytes, static_cast<std::size_t>(count));
    if (line.ends_with('\n')) line.pop_back();
    child::write_all(out, help.take(line));
  }
  child::write_all(out, help.finish());
  return 0;
}

}  // namespace

std::string MpiHelp::take(const std::string& line) {
  if (line == kDashes) {
    block_ += line + "\n";
    is_within_ = !is_within_;
    if (is_within_) return "";
    std::string block = std::exchange(block_, "");
    if (!is_help(block)) return block;
    help_ += block;
    return "";
  }
  if (is_within_) {
    block_ += line + "\n";
    is_within_ = block_.size() < kLongestHelp;
    return is_within_ ? "" : std::exchange(block_, "");
  }
  return is_remark(line) ? "" : line + "\n";
}

std::string MpiHelp::finish() const {
  const std::string help = launch::on_one_line(help_);
  const std::string prefix = block_ + "mars-nx: ";
  if (const auto death = death_in(help, has_host_)) return prefix + *death + "\n";
  if (const auto failure = failed_start_in(help)) return prefix + failure->what() + "\n";
  if (const auto meaning = launch::meaning_of(help)) return prefix + meaning->what() + "\n";
  return block_ + (says_nothing_new(help) ? "" : help_);
}

void explain_mpi_help(bool has_host) {
  child::Pipe pipe = child::make_pipe();
  child::Process reader(
      [&] {
        pipe.writing.close();
        for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGTSTP}) std::signal(signal, SIG_IGN);
        return filter(pipe, has_host);
      },
      {});
  reader.give_up();  // it ends when nothing more can come
  if (dup2(pipe.writing.number(), STDERR_FILENO) < 0) throw Failure("cannot be read", "standard error", "");
}

}  // namespace mars::nx_jobs
