// Flagged blocks of a picture as rectangles.
#pragma once

#include <cstdint>
#include <vector>

#include "host/render/compositor/block_flags.h"
#include "host/render/watch/watch_messages.h"

namespace mars::watch {

// Of a picture of this size: stretches of a row, joined to those above that are as wide. They do not overlap.
std::vector<Rect> flagged_rects(const compositor::BlockFlags& flags, std::uint32_t width, std::uint32_t height);

}  // namespace mars::watch
