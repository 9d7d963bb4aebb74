// A key that was pressed in a terminal: a character, or one of those that send several bytes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace mars::preview {

enum class Special { none, up, down, left, right, home, end, back_tab, escape };

struct KeyPress {
  char character = 0;  // if `special` is none
  Special special = Special::none;

  bool operator==(const KeyPress&) const = default;
};

inline constexpr std::string_view kEscape = "\x1b";  // the key alone, or what begins a sequence: time tells

// The keys in what a terminal sent; sequences that are none of ours are left out. What is begun and not complete at
// the end stays in `bytes`.
std::vector<KeyPress> take_keys(std::string& bytes);

}  // namespace mars::preview
