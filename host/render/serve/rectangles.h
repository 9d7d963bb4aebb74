// Flagged blocks of a picture as rectangles that do not overlap.
#pragma once

#include <vector>

#include "host/render/compositor/block_flags.h"
#include "host/render/serve/serve_messages.h"

namespace mars::serve {

// Stretches of one row after another that have the same columns are one rectangle.
std::vector<Rect> rectangles_of(const compositor::BlockFlags& flags, std::uint32_t width, std::uint32_t height);

}  // namespace mars::serve
