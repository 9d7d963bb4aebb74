#include "host/render/sinks/lease.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <time.h>

#include <cerrno>
#include <system_error>

#include "hal/failure/failure.h"
#include "host/content/document/file_failure.h"

namespace mars::sinks {

namespace {

constexpr double kTrusted = 30;  // seconds; others wait for 60 (folder_turn.h)

}  // namespace

double seconds_since_boot() {
  timespec time{};
  clock_gettime(CLOCK_BOOTTIME, &time);
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

Lease::Lease(std::filesystem::path file, Clock clock, std::chrono::milliseconds interval)
    : file_(std::move(file)), clock_(std::move(clock)), interval_(interval), renewed_(clock_()), thread_([this] {
        renew_until_stopped();
      }) {}

Lease::~Lease() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  stopping_.notify_one();
  thread_.join();
}

void Lease::renew_until_stopped() {
  std::unique_lock lock(mutex_);
  while (!stopping_.wait_for(lock, interval_, [this] { return stop_; })) renew();
}

void Lease::renew() {
  const double begun = clock_();
  error_ = utimensat(AT_FDCWD, file_.c_str(), nullptr, AT_SYMLINK_NOFOLLOW) == 0 ? 0 : errno;
  if (error_ == 0) renewed_ = begun;
  if (error_ == ENOENT || error_ == ENOTDIR) gone_ = true;
}

void Lease::check() {
  {
    const std::lock_guard lock(mutex_);
    if (!gone_ && clock_() - renewed_ < kTrusted) return;
  }
  confirm();
}

void Lease::confirm() {
  const std::lock_guard lock(mutex_);
  renew();
  if (gone_)
    throw Failure("this run's claim to the folder is gone: another run took this one for ended, or somebody removed it",
                  file_.string(), "see that no other run writes there, and render what mars verify --missing prints");
  if (clock_() - renewed_ >= kTrusted)
    throw document::FileFailure("this run's claim to the folder cannot be renewed: " +
                                    std::generic_category().message(error_),
                                file_.string(), "see whether its disk can still be written", error_);
}

}  // namespace mars::sinks
