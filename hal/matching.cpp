#include "hal/matching.h"

#include <algorithm>

#include "hal/requests.h"

namespace mars::hal {

void Matching::unpost(const Request& request) { std::erase(posted_, &request); }

Request* Matching::posted_for(const Envelope& envelope) const {
  const auto at = std::find_if(posted_.begin(), posted_.end(), [&](const Request* request) {
    return request->selection.selects(envelope);
  });
  return at == posted_.end() ? nullptr : *at;
}

}  // namespace mars::hal
