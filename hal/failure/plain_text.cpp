#include "hal/failure/plain_text.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>

namespace mars {
namespace {

std::uint32_t byte_of(std::string_view text, std::size_t at) { return static_cast<unsigned char>(text[at]); }

// Of the character of `length` bytes that `text` begins with.
std::uint32_t code_of(std::string_view text, std::size_t length) {
  if (length == 1) return byte_of(text, 0);
  std::uint32_t code = byte_of(text, 0) & (0xffu >> (length + 1));
  for (std::size_t at = 1; at < length; ++at) code = code << 6 | (byte_of(text, at) & 0x3f);
  return code;
}

bool only_shows(std::uint32_t code) {
  const bool control = code < 0x20 || (code >= 0x7f && code < 0xa0);
  const bool turns = (code >= 0x202a && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
  return !control && !turns;
}

std::string escaped(const char* format, std::uint32_t code) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), format, code);
  return text.data();
}

// Bytes of the character that `text` begins with; 0 where it begins with none.
std::size_t length_of_character(std::string_view text) {
  constexpr std::array<std::uint32_t, 5> kLeast = {0, 0, 0x80, 0x800, 0x10000};  // by length; fewer bytes hold less
  if (text.empty()) return 0;
  const std::uint32_t first = byte_of(text, 0);
  if (first < 0x80) return 1;
  const std::size_t length = first < 0xc0 ? 0 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : first < 0xf8 ? 4 : 0;
  if (length == 0 || text.size() < length) return 0;
  for (std::size_t at = 1; at < length; ++at)
    if ((byte_of(text, at) & 0xc0) != 0x80) return 0;
  const std::uint32_t code = code_of(text, length);
  const bool is_half = code >= 0xd800 && code < 0xe000;  // of a pair of UTF-16
  return code < kLeast[length] || is_half || code > 0x10ffff ? 0 : length;
}

// Characters of `layout` stay.
std::string plain(std::string_view text, std::string_view layout) {
  std::string plain;
  plain.reserve(text.size());
  while (!text.empty()) {
    const std::size_t length = length_of_character(text);
    const std::uint32_t code = length == 0 ? byte_of(text, 0) : code_of(text, length);
    if (length == 0) {
      plain += escaped("\\x%02x", code);
    } else if (only_shows(code) || (length == 1 && layout.find(text.front()) != std::string_view::npos)) {
      plain += text.substr(0, length);
    } else {
      plain += escaped("\\u%04x", code);
    }
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return plain;
}

}  // namespace

std::string plain_text(std::string_view text) { return plain(text, "\n\t"); }

std::string plain_line(std::string_view text) { return plain(text, ""); }

}  // namespace mars
