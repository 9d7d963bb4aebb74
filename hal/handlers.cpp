#include "hal/handlers.h"

#include <utility>

#include "hal/backend.h"

namespace mars::hal {

void Handler::operator()(const Envelope& envelope) const {
  const auto length = static_cast<long>(envelope.length);
  if (plain != nullptr) plain(envelope.type, length, envelope.from, 0);
  if (extended != nullptr) extended(envelope.type, length, envelope.from, 0, parameter);
}

Request* Handlers::next() {
  if (masked_ || running_ || due_.empty()) return nullptr;
  Request* request = due_.front();
  due_.erase(due_.begin());
  return request;
}

bool Handlers::mask(bool masked) { return std::exchange(masked_, masked); }

}  // namespace mars::hal
