// Strips that come by message, while their bytes come: a slow link takes long over one, and meanwhile the host goes on.
// Of each node they are taken in the order in which it sent them.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "host/render/farm/strip_message.h"

namespace mars::farm {

class StripReceipts {
 public:
  explicit StripReceipts(int nodes) : of_(static_cast<std::size_t>(nodes)) {}
  // The memory of what has not come stays the transport's until the process ends.
  ~StripReceipts();
  StripReceipts(const StripReceipts&) = delete;
  StripReceipts& operator=(const StripReceipts&) = delete;

  // Begins to receive the node's strip that was probed last into `bytes`, which are as long as it.
  void begin(int node, StripBytes bytes);
  // Begun and not taken.
  std::size_t count(int node) const { return of_.at(static_cast<std::size_t>(node)).size(); }
  // The node's next strip; none: it has not come whole.
  std::optional<StripBytes> take(int node);
  // The nodes that have some which were not taken, as they began.
  const std::vector<int>& nodes() const { return nodes_; }

 private:
  struct Receipt {
    StripBytes bytes;
    std::optional<long> message;  // its id; none: it has come
  };

  static bool has_come(Receipt& receipt);

  std::vector<std::vector<Receipt>> of_;
  std::vector<int> nodes_;
};

}  // namespace mars::farm
