#include "hal/messages/handlers.h"

#include <algorithm>
#include <utility>

#include "hal/messages/requests.h"

namespace mars::hal {

void Handler::operator()(const Envelope& envelope) const {
  const auto length = static_cast<long>(envelope.length);
  if (plain != nullptr) plain(envelope.type, length, envelope.from, 0);
  if (extended != nullptr) extended(envelope.type, length, envelope.from, 0, parameter);
}

void Handlers::sort_due(std::ptrdiff_t from) {
  std::sort(due_.begin() + from, due_.end(),
            [](const Request* a, const Request* b) { return a->arrival < b->arrival; });
}

Request* Handlers::next() {
  if (masked_ || running_ || due_.empty()) return nullptr;
  Request* request = due_.front();
  due_.erase(due_.begin());
  return request;
}

bool Handlers::mask(bool masked) { return std::exchange(masked_, masked); }

}  // namespace mars::hal
