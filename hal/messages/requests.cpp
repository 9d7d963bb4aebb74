#include "hal/messages/requests.h"

namespace mars::messages {
namespace {

constexpr int kSlotBits = 17;
constexpr int kSlots = 1 << kSlotBits;  // more than ids: calls that wait and handlers need none
constexpr int kUses = 1 << 14;

}  // namespace

long Request::mid() const { return static_cast<long>(uses) << kSlotBits | slot; }

Request* RequestTable::acquire(const char* call) {
  if (free_.empty() && requests_.size() == kSlots) return nullptr;
  if (free_.empty()) grow();
  Request& request = requests_[free_.back()];
  free_.pop_back();
  Request fresh;
  fresh.slot = request.slot;
  fresh.uses = (request.uses + 1) % kUses;
  fresh.call = call;
  return &(request = fresh);
}

Request* RequestTable::acquire_id(const char* call) {
  Request* request = ids_ < kMessageIds ? acquire(call) : nullptr;
  if (request == nullptr) return nullptr;
  request->has_id = true;
  ++ids_;
  return request;
}

void RequestTable::forget_id(Request& request) {
  if (request.has_id) --ids_;
  request.has_id = false;
}

void RequestTable::grow() {
  const int slot = static_cast<int>(requests_.size());
  requests_.emplace_back().slot = slot;
  if (free_.capacity() < requests_.size()) free_.reserve(2 * requests_.size());
  free_.push_back(slot);
}

Request* RequestTable::find(long mid) {
  const long slot = mid & (kSlots - 1);
  if (mid < 0 || slot >= static_cast<long>(requests_.size())) return nullptr;
  Request& request = requests_[slot];
  return request.mid() == mid && request.has_id ? &request : nullptr;
}

void RequestTable::release(Request& request) {
  forget_id(request);
  request.state = Request::State::free;
  free_.push_back(request.slot);
}

}  // namespace mars::messages
