#include "host/shell/batch/follow.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <thread>

#include "hal/failure/failure.h"
#include "host/child/standard_streams.h"
#include "host/content/document/text.h"
#include "host/content/document/text_lines.h"
#include "host/shell/batch/folder_state.h"
#include "host/shell/batch/remembered_jobs.h"

namespace mars::batch {

namespace {

using Clock = std::chrono::steady_clock;
using Lines = std::vector<std::string>;

constexpr std::chrono::seconds kPeriod{2};
constexpr std::chrono::seconds kBetweenRuns{30};  // a run that died may be started again
constexpr std::chrono::seconds kLongestEnd{120};  // Slurm's KillWait is 30 by default
constexpr std::size_t kUsualColumns = 80;

std::size_t columns() {
  winsize size{};
  const bool known = ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
  return known ? size.ws_col - 1u : kUsualColumns;
}

// Writes over the lines of the last time.
void rewrite(const Lines& before, const Lines& now) {
  std::ostream& out = child::raw_output();
  if (!before.empty()) out << "\x1b[" << before.size() << "A\r\x1b[J";
  for (const std::string& line : now) out << document::cut_to(line, columns()) << '\n';
  out << std::flush;
}

void print_new(const Lines& before, const Lines& now) {
  for (const std::string& line : now)
    if (std::ranges::find(before, line) == before.end()) std::cout << line << '\n';
  std::cout << std::flush;
}

}  // namespace

bool follow(const std::filesystem::path& folder) {
  const bool terminal = isatty(STDOUT_FILENO);
  Lines shown;
  std::optional<Clock::time_point> last_active;
  for (;;) {
    const FolderState state = look_at(folder);
    Lines lines = lines_of(state, terminal);
    terminal ? rewrite(shown, lines) : print_new(shown, lines);
    shown = std::move(lines);
    if (state.active()) last_active = Clock::now();
    const bool over = !last_active || Clock::now() - *last_active > kBetweenRuns;
    if (!state.active() && (state.complete() || over)) return state.complete();
    std::this_thread::sleep_for(kPeriod);
  }
}

void cancel(const std::filesystem::path& folder) {
  const std::vector<Jobs> jobs = jobs_of(folder);
  if (jobs.empty())
    throw Failure("no job was submitted for this folder by mars submit", folder.string(),
                  "end mars render where it runs; mars status shows on which machine");
  if (queued_jobs(jobs).empty()) {
    std::cout << "no job is left to cancel\n";
    return;
  }
  cancel_jobs(jobs);
  const Clock::time_point deadline = Clock::now() + kLongestEnd;
  for (std::vector<QueuedJob> left; !(left = queued_jobs(jobs)).empty(); std::this_thread::sleep_for(kPeriod / 4))
    if (Clock::now() > deadline)
      throw Failure("does not end: " + text_of(left.front()), folder.string(), "ask your administrators");
  for (const auto& [system, numbers] : jobs)
    for (const std::string& number : numbers) std::cout << "job " << number << " has ended\n";
}

}  // namespace mars::batch
