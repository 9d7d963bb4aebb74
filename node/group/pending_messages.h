// Messages that the calling node began to send or to receive, to be waited for together.
#pragma once

#include <cstddef>
#include <vector>

#include "hal/nx/nx_messages.h"

namespace mars::group {

class PendingMessages {
 public:
  PendingMessages() = default;
  // Up to `capacity` messages at a time cost no memory.
  explicit PendingMessages(std::size_t capacity) { ids_.reserve(capacity); }

  void add(long id) { ids_.push_back(id); }

  void wait() {
    for (const long id : ids_) msgwait(id);
    ids_.clear();
  }

 private:
  std::vector<long> ids_;
};

}  // namespace mars::group
