// What differs between two texts: one stretch of the one stands for one stretch of the other. Takes one to the other
// and back, byte for byte; of a step in a large file it is small.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace mars::studio {

struct TextChange {
  std::size_t at = 0;  // bytes from the start
  std::string before, after;

  // What the text becomes; none where it has not this change's `before` at its place.
  std::optional<std::string> done(std::string_view text) const;
  std::optional<std::string> undone(std::string_view text) const;
  std::size_t bytes() const { return before.size() + after.size(); }
};

// The shortest that splits no character of UTF-8.
TextChange change_between(std::string_view before, std::string_view after);

}  // namespace mars::studio
