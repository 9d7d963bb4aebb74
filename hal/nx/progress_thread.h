// Handlers that run while their program computes: a thread that looks now and then for messages of one process and
// calls the handlers that are due, never during the process's own NX calls (call_lock.h), in which they run anyway. The
// backend's calls then come from two threads, one at a time. While a handler runs, the process's own NX calls wait,
// masktrap too: what a handler shares with its program is safe between masktrap(1) and masktrap(0).
#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

#include "hal/messages/process.h"

namespace mars::nx {

class ProgressThread {
 public:
  // On the process's thread, as is the destructor, which waits for the handler that runs. A handler that fails ends all
  // ranks.
  explicit ProgressThread(messages::Process& process);
  ~ProgressThread();
  ProgressThread(const ProgressThread&) = delete;
  ProgressThread& operator=(const ProgressThread&) = delete;

 private:
  void run();
  bool rest();

  messages::Process& process_;
  std::mutex calls_;
  std::mutex ending_mutex_;
  std::condition_variable ending_news_;
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace mars::nx
