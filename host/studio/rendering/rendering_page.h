// A page's view of a rendering: at most two pictures that it has not painted, then the newest.
#pragma once

#include <cstdint>
#include <optional>

#include "host/render/compositor/block_flags.h"

namespace mars::studio {

struct RenderingPage {
  static constexpr std::uint32_t kMostUnpainted = 2;

  compositor::BlockFlags due;          // of what is drawn, that the page does not have
  std::uint32_t picture = 0;           // the last one sent
  std::uint32_t painted = 0;           // the last one that the page has painted
  std::optional<std::uint32_t> scrub;  // the finished frame it looks at; none: what is drawn
  bool scrub_due = false;              // that frame is to be sent

  bool has_room() const { return picture - painted < kMostUnpainted; }
};

}  // namespace mars::studio
