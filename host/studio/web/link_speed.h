// How fast the link to a page is, from what the page acknowledges, and how pictures are best sent over it. A time holds
// the page's own work too, decoding and the wait for the screen; what is quicker than that tells only that the link is
// at least so fast.
#pragma once

#include <cstddef>

#include "host/studio/web/picture_message.h"

namespace mars::web {

class LinkSpeed {
 public:
  // `bytes` took these seconds, from when the link was free for them until the page had painted them.
  void acknowledged(std::size_t bytes, double seconds);

  double bytes_a_second() const { return speed_; }
  // `lossy`: it may lose a little.
  Encoding best_for(std::size_t pixel_bytes, bool lossy) const;

 private:
  double speed_ = 20e6;
  double shortest_ = 1;  // seconds that anything took
};

}  // namespace mars::web
