// Names, numbers and lists as text, for messages and tables; numbers from text.
#pragma once

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace mars::document {

// The name, or the beginning of a long one and "...".
std::string shortened(std::string_view name);

// "'knee'", long names shortened().
std::string in_quotes(std::string_view name);

// The beginning of a foreign file's bytes; '?' stands for those that are not printable ASCII.
std::string printable(std::string_view bytes, std::size_t longest = 60);

// Bytes that are no UTF-8, as older programs write them, become U+FFFD.
std::string in_utf8(const std::string& text);

// "hip, knee, ankle".
template <typename Texts>
std::string joined(const Texts& texts, std::string_view separator = ", ") {
  std::string all;
  std::string_view before;
  for (const auto& text : texts) {
    all.append(before).append(text);
    before = separator;
  }
  return all;
}

// "1 vertex", "2 vertices"; of one word: "1 node", "2 nodes".
std::string counted(std::uint64_t count, std::string_view one, std::string_view several);
std::string counted(std::uint64_t count, std::string_view one);

// As std::printf writes it.
[[gnu::format(printf, 1, 2)]] std::string formatted(const char* format, ...);

// "12.5": up to nine digits.
std::string shown(double number);

// The nearest number of `digits` decimal digits.
double rounded_to(double number, int digits);

// The number that the whole text is, as std::from_chars reads it; none where the text is anything else.
template <typename Number>
std::optional<Number> number_in(std::string_view text) {
  Number number{};
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, number);
  return error == std::errc() && end == last ? std::optional(number) : std::nullopt;
}

}  // namespace mars::document
