#include "hal/requests.h"

#include <algorithm>

#include "hal/message_types.h"

namespace mars::hal {
namespace {

constexpr int kSlotBits = 16;
constexpr int kSlots = 1 << kSlotBits;
constexpr int kUses = 1 << 15;

}  // namespace

long Request::mid() const { return static_cast<long>(uses) << kSlotBits | slot; }

Request* RequestTable::acquire(const char* call) {
  if (free_.empty() && requests_.size() == kSlots) return nullptr;
  if (free_.empty()) grow();
  Request& request = requests_[free_.back()];
  free_.pop_back();
  request.uses = (request.uses + 1) % kUses;
  request.call = call;
  return &request;
}

void RequestTable::grow() {
  const int slot = static_cast<int>(requests_.size());
  requests_.emplace_back().slot = slot;
  free_.reserve(requests_.size());
  posted_.reserve(requests_.size());
  free_.push_back(slot);
}

Request* RequestTable::find(long mid) {
  const long slot = mid & (kSlots - 1);
  if (mid < 0 || slot >= static_cast<long>(requests_.size())) return nullptr;
  Request& request = requests_[slot];
  return request.mid() == mid && request.state != Request::State::free ? &request : nullptr;
}

void RequestTable::release(Request& request) {
  request.state = Request::State::free;
  free_.push_back(request.slot);
}

void RequestTable::unpost(const Request& request) { std::erase(posted_, &request); }

Request* RequestTable::posted_for(std::int32_t type) const {
  const auto at = std::find_if(posted_.begin(), posted_.end(),
                               [type](const Request* request) { return selects(request->typesel, type); });
  return at == posted_.end() ? nullptr : *at;
}

}  // namespace mars::hal
