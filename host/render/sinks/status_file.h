// Keeps a run's .status young, by a thread of its own. Nobody waits for it, and a file that cannot be written now is
// written later or not at all: what only informs must not end a run.
#pragma once

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace mars::sinks {

class StatusFile {
 public:
  // `text` is called by the thread. `part` is the temporary file, in the same folder.
  StatusFile(std::filesystem::path file, std::filesystem::path part, std::function<std::string()> text,
             std::chrono::milliseconds interval = std::chrono::seconds(2));
  // Writes it once more.
  ~StatusFile();
  StatusFile(const StatusFile&) = delete;
  StatusFile& operator=(const StatusFile&) = delete;

 private:
  void write_until_stopped();
  void write() const;

  const std::filesystem::path file_, part_;
  const std::function<std::string()> text_;
  const std::chrono::milliseconds interval_;
  std::mutex mutex_;
  std::condition_variable stopping_;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace mars::sinks
