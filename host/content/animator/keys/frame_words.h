// Frames and eases as people type them after a command.
#pragma once

#include <cstdint>
#include <string>

#include "host/content/animator/pose/ease.h"
#include "host/content/animator/keys/frame_range.h"

namespace mars::animator {

// "24", "24-48", or "24-" to the last frame that a film can have. Throws Failure at other text.
FrameRange read_frame_range(const std::string& text);
// "at frame 24", "in frames 24 to 48", "from frame 24 on".
std::string shown_range(FrameRange range);
// "24".
std::uint32_t read_frame(const std::string& text);

// "both" or "0.4,0,0.6,1". Throws Failure without a place.
Ease read_typed_ease(const std::string& text);

}  // namespace mars::animator
