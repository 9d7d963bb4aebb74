#include "host/render/sinks/status_file.h"

#include <exception>
#include <system_error>
#include <utility>

#include "host/content/document/whole_file.h"

namespace mars::sinks {

namespace fs = std::filesystem;

StatusFile::StatusFile(fs::path file, fs::path part, std::function<std::string()> text,
                       std::chrono::milliseconds interval)
    : file_(std::move(file)), part_(std::move(part)), text_(std::move(text)), interval_(interval), thread_([this] {
        write_until_stopped();
      }) {}

StatusFile::~StatusFile() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  stopping_.notify_one();
  thread_.join();
}

void StatusFile::write_until_stopped() {
  std::unique_lock lock(mutex_);
  do {
    lock.unlock();
    write();
    lock.lock();
  } while (!stopping_.wait_for(lock, interval_, [this] { return stop_; }));
  lock.unlock();
  write();
}

// It need not be on the disk: after a loss of power it says nothing of worth.
void StatusFile::write() const {
  try {
    std::error_code ignored;
    fs::remove(part_, ignored);
    if (document::create_file(part_, text_())) fs::rename(part_, file_);
  } catch (const std::exception&) {
  }
}

}  // namespace mars::sinks
