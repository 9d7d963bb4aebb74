// The handlers (handler.h) of requests under way and done. They run inside of the process's
// message calls (or between them, see progress_thread.h), one at a time and in the order in which the
// requests were done: while one runs, or while they are masked, those that are due wait.
#pragma once

#include <cstddef>
#include <vector>

#include "hal/messages/requests.h"

namespace mars::messages {

class HandlerQueue {
 public:
  // There is a request with a handler, or one to be forgotten when it is done.
  bool any() const { return !waiting_.empty() || !due_.empty(); }

  // A request that has a handler, or that is to be forgotten when it is done.
  void add(Request& request) { waiting_.push_back(&request); }
  // Those for which `done` is true are due, in the order in which their messages arrived.
  template <class Done>
  void sort_out(Done done) {
    const auto before = static_cast<std::ptrdiff_t>(due_.size());
    std::erase_if(waiting_, [&](Request* request) {
      const bool is_done = done(*request);
      if (is_done) due_.push_back(request);
      return is_done;
    });
    sort_due(before);
  }
  // The next whose handler may run now, which is then no longer due; or nullptr.
  Request* next();

  // Returns what was before.
  bool mask(bool masked);

  // While one lives, a handler runs.
  class Running {
   public:
    explicit Running(HandlerQueue& handlers) : handlers_(handlers) { handlers_.running_ = true; }
    ~Running() { handlers_.running_ = false; }
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;

   private:
    HandlerQueue& handlers_;
  };

 private:
  void sort_due(std::ptrdiff_t from);

  std::vector<Request*> waiting_;
  std::vector<Request*> due_;
  bool masked_ = false;
  bool running_ = false;
};

}  // namespace mars::messages
