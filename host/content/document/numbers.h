// Numbers as text: what a person typed or a file holds, and how numbers are written.
#pragma once

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

namespace mars::host {

// The number that the whole text is, as std::from_chars reads it; none where the text is anything else.
template <typename Number>
std::optional<Number> number_in(std::string_view text) {
  Number number{};
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, number);
  return error == std::errc() && end == last ? std::optional(number) : std::nullopt;
}

}  // namespace mars::host
