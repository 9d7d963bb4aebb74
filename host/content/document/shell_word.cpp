#include "host/content/document/shell_word.h"

#include <array>
#include <cstdio>
#include <string_view>

#include "hal/failure/plain_text.h"

namespace mars::document {
namespace {

// $'...', which has escapes: for what cannot be shown as it is.
std::string escaped(const std::string& word) {
  std::string text = "$'";
  for (const char c : word) {
    std::array<char, 8> byte{c};
    const auto code = static_cast<unsigned char>(c);
    if (code < ' ' || code >= 0x7f || c == '\'' || c == '\\') std::snprintf(byte.data(), byte.size(), "\\%03o", code);
    text += byte.data();
  }
  return text + "'";
}

}  // namespace

std::string shell_word(const std::string& word) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%^";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  if (plain_line(word) != word) return escaped(word);
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

}  // namespace mars::document
