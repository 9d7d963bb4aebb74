// What files, people and other machines wrote, as text that only shows: nothing in it acts on a terminal or turns the
// order of what stands beside it.
#pragma once

#include <string>
#include <string_view>

namespace mars {

// Text in UTF-8. Of control characters newline and tab stay; others, and those that turn the direction of writing,
// become \u001b, as JSON writes them, so that JSON remains the same JSON. Bytes that are no UTF-8 become \xff.
std::string plain_text(std::string_view text);
// The same in one line: newline and tab are written \u000a and \u0009.
std::string plain_line(std::string_view text);

}  // namespace mars
