#include "hal/messages/handler_queue.h"

#include <algorithm>
#include <utility>

namespace mars::messages {

void HandlerQueue::sort_due(std::ptrdiff_t from) {
  std::sort(due_.begin() + from, due_.end(),
            [](const Request* a, const Request* b) { return a->arrival < b->arrival; });
}

Request* HandlerQueue::next() {
  if (masked_ || running_ || due_.empty()) return nullptr;
  Request* request = due_.front();
  due_.erase(due_.begin());
  return request;
}

bool HandlerQueue::mask(bool masked) { return std::exchange(masked_, masked); }

}  // namespace mars::messages
