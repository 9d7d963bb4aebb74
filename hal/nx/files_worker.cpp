#include "hal/nx/files_worker.h"

#include <signal.h>
#include <unistd.h>

#include <cerrno>

namespace mars::nx {
namespace {

constexpr std::size_t kIds = 4096;  // at a time
constexpr long kLastId = 0x7fffffff;

ssize_t transfer_some(const Transfer& what, std::size_t done) {
  std::byte* bytes = static_cast<std::byte*>(what.buffer) + done;
  const std::size_t rest = what.length - done;
  if (!what.at) return what.write ? ::write(what.fd, bytes, rest) : ::read(what.fd, bytes, rest);
  const off_t at = *what.at + static_cast<off_t>(done);
  return what.write ? ::pwrite(what.fd, bytes, rest, at) : ::pread(what.fd, bytes, rest, at);
}

}  // namespace

Transferred transfer(const Transfer& what) {
  Transferred came;
  while (came.bytes < what.length) {
    const ssize_t moved = transfer_some(what, came.bytes);
    if (moved < 0 && errno == EINTR) continue;
    if (moved < 0) came.error = errno;
    if (moved <= 0) break;
    came.bytes += static_cast<std::size_t>(moved);
  }
  return came;
}

FilesWorker::~FilesWorker() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

// The thread takes no signal: they are the program's.
std::optional<long> FilesWorker::start(const Transfer& what) {
  if (!thread_.joinable()) {
    sigset_t all;
    sigset_t before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    thread_ = std::thread([this] { work(); });
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
  }
  const std::lock_guard lock(mutex_);
  if (jobs_.size() == kIds) return std::nullopt;
  const long id = next_id();
  jobs_.emplace(id, Job{what, {}});
  waiting_.push_back(id);
  changed_.notify_all();
  return id;
}

long FilesWorker::next_id() {
  do {
    last_id_ = last_id_ == kLastId ? 0 : last_id_ + 1;
  } while (jobs_.contains(last_id_));
  return last_id_;
}

void FilesWorker::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return ending_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    Job& job = jobs_.at(waiting_.front());
    waiting_.pop_front();
    const Transfer what = job.what;
    lock.unlock();
    const Transferred came = transfer(what);
    lock.lock();
    job.came = came;  // a job stays where it is until it is done and asked after
    changed_.notify_all();
  }
}

bool FilesWorker::known(long id) {
  const std::lock_guard lock(mutex_);
  return jobs_.contains(id);
}

std::optional<Transferred> FilesWorker::look(long id) {
  const std::lock_guard lock(mutex_);
  if (!jobs_.at(id).came) return std::nullopt;
  return jobs_.extract(id).mapped().came;
}

Transferred FilesWorker::wait(long id) {
  std::unique_lock lock(mutex_);
  const Job& job = jobs_.at(id);
  changed_.wait(lock, [&job] { return job.came.has_value(); });
  return *jobs_.extract(id).mapped().came;
}

}  // namespace mars::nx
