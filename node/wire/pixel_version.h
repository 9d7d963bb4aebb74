// Which pixels this renderer draws: a number that grows when any pixel of any film may come out otherwise. Folders of
// frames and the frames themselves have it (host/render/sinks), so that frames of two renderers are never mixed
// unasked. tests/render/pixel_version_test.cpp holds it to the pixels of stored films.
#pragma once

#include <cstdint>

namespace mars::wire {

inline constexpr std::uint32_t kPixelVersion = 2;

// Of all programs before the number was recorded.
inline constexpr std::uint32_t kFirstPixelVersion = 1;

}  // namespace mars::wire
