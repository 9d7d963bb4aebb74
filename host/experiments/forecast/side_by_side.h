// Does several things on several processors.
#pragma once

#include <cstddef>
#include <functional>

namespace mars::forecast {

// `action` with each number below `count`, on at most `threads` threads, in any order. Rethrows what one of them threw.
void side_by_side(std::size_t count, int threads, const std::function<void(std::size_t)>& action);

}  // namespace mars::forecast
