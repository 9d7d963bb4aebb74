// Storage that takes no files may soon take them again: a disk is full or a quota used up until somebody makes room, a
// file system cannot be written, or its server does not answer, until somebody puts that right. Whoever writes waits
// for it, within bounds, and says so: at once where writing fails, after a while where the system gives no answer at
// all.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <list>
#include <mutex>
#include <string>
#include <thread>

#include "host/content/document/file_failure.h"

namespace mars::sinks {

class Patience {
 public:
  using Duration = std::chrono::milliseconds;

  // Time counts as it is observed: of a process that is stopped meanwhile, a pause at most.
  struct Bounds {
    std::function<void(const std::string& line)> warn{};  // from any thread, one at a time; none: nobody listens
    Duration longest = std::chrono::minutes(10);          // waiting for one file
    Duration pause = std::chrono::seconds(1);             // from one try to the next
    Duration silence = std::chrono::seconds(10);          // without an answer, until that is said
  };

  explicit Patience(Bounds bounds);
  ~Patience();
  Patience(const Patience&) = delete;
  Patience& operator=(const Patience&) = delete;

  using Write = std::function<void()>;
  // Calls `write`, from several threads at once, until it throws no FileFailure of a kind that may pass, or for as long
  // as the bounds say. Then throws it, with how to go on. `file`: what is written, for people.
  void write(const std::filesystem::path& file, const Write& write) { repeat({file}, write); }
  // As write(), where nothing has been written yet: permissions that are lacking then are no reason to wait, but likely
  // to be the wrong folder's.
  void begin(const std::filesystem::path& file, const Write& write) { repeat({file, false}, write); }
  // Where what is written waits for something else than storage.
  void note_answer();

  // Throws Failure where the system has given no answer for as long as the bounds say.
  void check();
  // From now on nothing waits, and nothing is said.
  void give_up();

 private:
  struct Try {
    std::filesystem::path file;
    bool begun = true;  // the same place could be written before
    bool pausing = false;
    bool failed = false;  // before
    Duration silent{0};   // since it was begun, tried again, or answered
    Duration waited{0};   // before that
  };
  using Place = std::list<Try>::iterator;

  void repeat(const Try& task, const Write& write);
  Place add(const Try& task);
  bool waits_after(const document::FileFailure& failure, Try& failed);
  Try end(Place place, bool written);
  bool any_failed() const;
  void watch();
  void look();
  void warn(const std::string& line) const;

  const Bounds bounds_;
  std::mutex mutex_;  // guards what follows
  std::condition_variable change_;
  std::list<Try> tries_;          // under way
  std::filesystem::path silent_;  // the file that was said to have no answer; "": none
  bool given_up_ = false;
  bool stop_ = false;
  std::atomic<bool> overdue_ = false;
  std::thread watch_;
};

}  // namespace mars::sinks
