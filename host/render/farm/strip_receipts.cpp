#include "host/render/farm/strip_receipts.h"

#include <utility>

#include "hal/nx/nx_messages.h"
#include "node/wire/protocol.h"

namespace mars::farm {

StripReceipts::~StripReceipts() {
  for (auto& receipts : of_)
    for (Receipt& receipt : receipts)
      if (!has_come(receipt)) static_cast<void>(receipt.bytes.data.release());
}

// Asks at once, so that the message that was probed is this one's.
void StripReceipts::begin(int node, StripBytes bytes) {
  auto& receipts = of_.at(static_cast<std::size_t>(node));
  if (receipts.empty()) nodes_.push_back(node);
  const long message = irecv(wire::kStrip, bytes.data.get(), static_cast<long>(bytes.size));
  receipts.push_back({std::move(bytes), message});
  has_come(receipts.back());
}

std::optional<StripBytes> StripReceipts::take(int node) {
  auto& receipts = of_.at(static_cast<std::size_t>(node));
  if (receipts.empty() || !has_come(receipts.front())) return std::nullopt;
  StripBytes bytes = std::move(receipts.front().bytes);
  receipts.erase(receipts.begin());
  if (receipts.empty()) std::erase(nodes_, node);
  return bytes;
}

bool StripReceipts::has_come(Receipt& receipt) {
  if (receipt.message && msgdone(*receipt.message) != 0) receipt.message.reset();
  return !receipt.message;
}

}  // namespace mars::farm
