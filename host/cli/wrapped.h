// Text in lines that a terminal of 80 columns shows whole.
#pragma once

#include <string>

namespace mars::cli {

inline constexpr std::size_t kColumns = 80;

// `text` broken at spaces so that, written from column `indent` on, it ends before `columns`; every line but the
// first begins with as many spaces. Words that are longer stay whole, line ends of its own are kept.
std::string wrapped(const std::string& text, std::size_t indent, std::size_t columns = kColumns);

}  // namespace mars::cli
