// Text for the lines of a terminal. Characters are counted, not bytes; what would move the cursor is
// shown (hal/failure/plain_text.h).
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace mars::document {

// The first `columns` characters.
std::string cut_to(std::string_view text, std::size_t columns);

// In lines of at most `columns` characters, broken at spaces where there are any. What does not fit in `lines` lines is
// left out, and "..." stands for it. Both at least 1.
std::vector<std::string> wrapped(std::string_view text, std::size_t columns, std::size_t lines);

}  // namespace mars::document
