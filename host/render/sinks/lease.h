// Keeps a file's time young while this process runs, so that processes on other machines, which see no more of it, know
// that it does. A process that was stopped for so long that others may take it for ended notices that before it goes
// on.
#pragma once

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <mutex>
#include <thread>

namespace mars::sinks {

// Seconds that pass also while the machine sleeps.
double seconds_since_boot();

class Lease {
 public:
  using Clock = std::function<double()>;

  // Renews `file`, which is there, once every `interval`, by a thread of its own.
  explicit Lease(std::filesystem::path file, Clock clock = seconds_since_boot,
                 std::chrono::milliseconds interval = std::chrono::seconds(10));
  ~Lease();
  Lease(const Lease&) = delete;
  Lease& operator=(const Lease&) = delete;

  // Renews it. Throws Failure where the file is gone, and FileFailure where it could not be renewed for half the time
  // after which others give it up: once it can be, and still is there, all is well again.
  void confirm();
  // As confirm(), but only if the last renewal is half that time ago, or the file is gone.
  void check();

 private:
  void renew();
  void renew_until_stopped();

  const std::filesystem::path file_;
  const Clock clock_;
  const std::chrono::milliseconds interval_;
  std::mutex mutex_;  // guards what follows
  std::condition_variable stopping_;
  double renewed_;
  int error_ = 0;  // of the last renewal, an errno
  bool gone_ = false;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace mars::sinks
