#include "host/render/sinks/folder_turn.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "hal/failure/failure.h"
#include "host/content/document/whole_file.h"

namespace mars::sinks {

namespace fs = std::filesystem;

namespace {

constexpr double kLongestSilence = 60;  // seconds

// When a file was last changed, in seconds by the clock of the machine that keeps it. Opening it makes NFS ask that
// machine, and not answer from what it remembers.
std::optional<double> time_of(const fs::path& file) {
  struct stat status {};
  const int opened = open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK);
  const int failed = opened < 0 ? lstat(file.c_str(), &status) : fstat(opened, &status);
  if (opened >= 0) close(opened);
  if (failed != 0) return std::nullopt;
  return static_cast<double>(status.st_mtim.tv_sec) + static_cast<double>(status.st_mtim.tv_nsec) * 1e-9;
}

bool touch(const fs::path& file) { return utimensat(AT_FDCWD, file.c_str(), nullptr, AT_SYMLINK_NOFOLLOW) == 0; }

}  // namespace

FolderTurn::FolderTurn(const RunsFolder& runs, std::chrono::milliseconds patience)
    : runs_(runs),
      file_(runs.add_own_file(kWaitsEnding, to_json(runs.self()).dump())),
      deadline_(Clock::now() + patience) {
  try {
    wait();
  } catch (...) {
    unlink(file_.c_str());
    throw;
  }
}

FolderTurn::~FolderTurn() {
  unlink(file_.c_str());
  runs_.remove_if_empty();
}

void FolderTurn::wait() {
  while (!take()) {
    if (Clock::now() > deadline_) fail_late();
    pause();
  }
}

// Renews the file too: where this process cannot be seen, the file counts for a minute, and waiting may take longer.
void FolderTurn::pause() {
  touch(file_);
  std::this_thread::sleep_for(pauses_.next());
}

bool FolderTurn::take() {
  const auto gives_way = [this](const std::vector<RunFiles>& others) {
    return !others.empty() && others.front().run < runs_.own_name();
  };
  if (gives_way(rivals())) return false;
  rename_to(kTurnEnding);
  std::vector<RunFiles> others = rivals();
  while (!others.empty() && !gives_way(others) && Clock::now() <= deadline_) {
    pause();
    others = rivals();
  }
  if (others.empty()) return true;
  rename_to(kWaitsEnding);
  return false;
}

// Other runs that ask for the turn or have it, by name.
std::vector<RunFiles> FolderTurn::rivals() const {
  std::vector<RunFiles> all = runs_.runs();
  std::erase_if(all, [this](const RunFiles& run) {
    const bool asks = std::ranges::any_of(run.files, [](const fs::path& f) { return f.extension() == kTurnEnding; });
    return run.run == runs_.own_name() || !asks || has_ended(run);
  });
  return all;
}

void FolderTurn::rename_to(std::string_view ending) {
  fs::path renamed = runs_.own_file(ending);
  if (rename(file_.c_str(), renamed.c_str()) != 0) fail("rename", errno);
  file_ = std::move(renamed);
}

void FolderTurn::confirm() const {
  if (!touch(file_)) fail("renew", errno);
}

void FolderTurn::fail_late() const {
  std::string others = "another run";
  for (const RunFiles& rival : rivals()) {
    const ProcessName process = process_of(rival);
    others += ", process " + std::to_string(process.number) + " on host " + process.host + ",";
  }
  throw Failure(others + " begins or ends in this folder, and does not go on", file_.parent_path().string(),
                "continue that process, or end it");
}

void FolderTurn::fail(const char* act, int error) const {
  if (error != ENOENT) document::fail_file(act, file_, error);
  throw Failure("this run was held up, and another has taken it for ended", file_.parent_path().string(),
                "start it again");
}

bool FolderTurn::sees(const RunFiles& run) const {
  return is_running(process_of(run), runs_.self()) != Running::unknown;
}

double FolderTurn::last_sign_of(const RunFiles& run) {
  double last = 0;
  for (const fs::path& file : run.files) last = std::max(last, time_of(file).value_or(0));
  return last;
}

bool FolderTurn::has_ended(const RunFiles& run) const {
  const Running running = is_running(process_of(run), runs_.self());
  if (running != Running::unknown) return running == Running::no;
  touch(file_);
  const std::optional<double> now = time_of(file_);
  const double last = last_sign_of(run);
  return now && last > 0 && *now - last > kLongestSilence;  // 0: its files are renamed or gone meanwhile
}

}  // namespace mars::sinks
