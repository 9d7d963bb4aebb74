#include "hal/messages/matching.h"

#include <algorithm>

namespace mars::messages {

// From the end: what is given up was often posted last.
void Matching::unpost(const Request& request) {
  posted_.erase(std::find(posted_.rbegin(), posted_.rend(), &request).base() - 1);
}

Request* Matching::posted_for(const Envelope& envelope) const {
  const auto at = std::find_if(posted_.begin(), posted_.end(),
                               [&](const Request* request) { return request->selection.selects(envelope); });
  return at == posted_.end() ? nullptr : *at;
}

}  // namespace mars::messages
