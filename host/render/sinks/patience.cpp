#include "host/render/sinks/patience.h"

#include <algorithm>
#include <cerrno>
#include <utility>

#include "host/content/document/text.h"

namespace mars::sinks {

namespace {

constexpr const char* kWayOn = "the same command then goes on where this run stopped";

bool may_pass(int error, bool begun) {
  switch (error) {
    case ENOSPC:
    case EDQUOT:
    case EIO:
    case ESTALE:
    case ETIMEDOUT: return true;
    case EROFS:
    case EACCES: return begun;
    default: return false;
  }
}

std::string text_of(Patience::Duration time) {
  const auto seconds = static_cast<std::uint64_t>(std::chrono::ceil<std::chrono::seconds>(time).count());
  return seconds % 60 == 0 ? document::counted(seconds / 60, "minute") : document::counted(seconds, "second");
}

// A failure that says how to go on.
document::FileFailure with_way_on(document::FileFailure failure, Patience::Duration waited) {
  if (waited.count() > 0) failure.problem += ", after waiting for " + text_of(waited);
  const std::string remedy = failure.remedy.empty() ? kWayOn : failure.remedy + "; " + kWayOn;
  return {failure.problem, failure.where, remedy, failure.error};
}

}  // namespace

Patience::Patience(Bounds bounds) : bounds_(std::move(bounds)), watch_([this] { watch(); }) {}

Patience::~Patience() {
  give_up();
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  change_.notify_all();
  watch_.join();
}

void Patience::repeat(const Try& task, const Write& write) {
  const Place place = add(task);
  while (true) {
    try {
      write();
      end(place, true);
      return;
    } catch (const document::FileFailure& failure) {
      if (waits_after(failure, *place)) continue;
      const Try ended = end(place, false);
      if (!ended.begun && !ended.failed) throw;
      throw with_way_on(failure, ended.waited);
    } catch (...) {
      end(place, false);
      throw;
    }
  }
}

Patience::Place Patience::add(const Try& task) {
  const std::lock_guard lock(mutex_);
  return tries_.insert(tries_.end(), task);
}

// Whether it is tried again now.
bool Patience::waits_after(const document::FileFailure& failure, Try& failed) {
  std::unique_lock lock(mutex_);
  if (given_up_ || !may_pass(failure.error, failed.begun) || failed.waited >= bounds_.longest) return false;
  if (!any_failed())
    warn((failure.where.empty() ? "" : failure.where + ": ") + failure.problem + "; waiting up to " +
         text_of(bounds_.longest) + ": the run goes on by itself, and the same command goes on later");
  failed.waited += bounds_.pause + std::exchange(failed.silent, Duration(0));
  failed.failed = failed.pausing = true;
  change_.wait_for(lock, bounds_.pause, [this] { return given_up_; });
  failed.pausing = false;
  return true;
}

Patience::Try Patience::end(Place place, bool written) {
  const std::lock_guard lock(mutex_);
  Try ended = std::move(*place);
  tries_.erase(place);
  if (written && ended.failed && !any_failed()) warn(ended.file.string() + " is written: the run goes on");
  return ended;
}

bool Patience::any_failed() const { return std::ranges::any_of(tries_, &Try::failed); }

void Patience::watch() {
  std::unique_lock lock(mutex_);
  while (!change_.wait_for(lock, bounds_.pause, [this] { return stop_; })) look();
}

void Patience::look() {
  Duration longest{0};
  std::filesystem::path slowest;
  for (Try& each : tries_) {
    if (each.pausing) continue;
    each.silent += bounds_.pause;
    if (each.silent > longest) slowest = each.file;
    longest = std::max(longest, each.silent);
  }
  overdue_ = longest >= bounds_.longest;
  if (longest < bounds_.silence) {
    if (!silent_.empty() && !any_failed()) warn("storage answers again: the run goes on");
    silent_.clear();
  } else if (silent_.empty() && !any_failed()) {
    silent_ = slowest;
    warn(silent_.string() + ": storage has given no answer for " + text_of(longest) +
         ", or is slow; the run goes on by itself");
  }
}

void Patience::note_answer() {
  const std::lock_guard lock(mutex_);
  for (Try& each : tries_) each.silent = Duration(0);
}

void Patience::check() {
  if (!overdue_) return;
  const std::lock_guard lock(mutex_);
  throw Failure("storage has given no answer for " + text_of(bounds_.longest), silent_.string(),
                "see whether the machine that keeps the files can be reached; " + std::string(kWayOn));
}

void Patience::give_up() {
  {
    const std::lock_guard lock(mutex_);
    given_up_ = true;
  }
  change_.notify_all();
}

void Patience::warn(const std::string& line) const {
  if (bounds_.warn && !given_up_) bounds_.warn(line);
}

}  // namespace mars::sinks
