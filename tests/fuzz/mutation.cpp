#include "tests/fuzz/mutation.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstring>

namespace mars::fuzz {
namespace {

constexpr std::size_t kLongest = 1 << 16;  // bytes that an input grows to

// What numbers and texts are at their edges.
constexpr auto kEdgeWords =
    std::to_array<std::string_view>({"0",          "-1",          "1",          "-0",         "0.5",
                                     "2147483647", "-2147483648", "4294967295", "4294967296", "18446744073709551616",
                                     "1e308",      "-1e308",      "1e-320",     "1e999",      "nan",
                                     "inf",        "0x10",        "1e5",        "999999999",  "\"\"",
                                     "\"a\"",      "{}",          "[]",         "null",       "true",
                                     "[[[[[[[[",   "\\u0000",     "\x1b[2J",    "\xff\xfe",   "..",
                                     "/",          "%n",          "-",          ",",          ":",
                                     "\n",         "\r\n",        " "});

enum class Kind { letters, digits, space, other };

Kind kind_of(char c) {
  const auto byte = static_cast<unsigned char>(c);
  if (std::isdigit(byte) || c == '.' || c == '-' || c == '+') return Kind::digits;
  if (std::isalpha(byte) || c == '_') return Kind::letters;
  return std::isspace(byte) ? Kind::space : Kind::other;
}

}  // namespace

std::string Mutation::of_text(std::string_view text, std::string_view other) {
  std::string changed(text);
  for (std::size_t changes = 1 + below(4); changes > 0; --changes) change_text(changed, other);
  changed.resize(std::min(changed.size(), kLongest));
  return changed;
}

std::string Mutation::of_bytes(std::string_view bytes, std::string_view other) {
  std::string changed(bytes);
  for (std::size_t changes = 1 + below(6); changes > 0; --changes) change_bytes(changed, other);
  changed.resize(std::min(changed.size(), kLongest));
  return changed;
}

Mutation::Span Mutation::word_at(std::string_view text, std::size_t at) const {
  const Kind kind = kind_of(text[at]);
  std::size_t begin = at, end = at + 1;
  if (kind == Kind::other) return {begin, end};
  while (begin > 0 && kind_of(text[begin - 1]) == kind) --begin;
  while (end < text.size() && kind_of(text[end]) == kind) ++end;
  return {begin, end};
}

// A word, mostly; else several, or a line.
Mutation::Span Mutation::some_span(std::string_view text, bool text_form) {
  if (text.empty()) return {0, 0};
  const std::size_t at = below(text.size());
  if (!text_form) return {at, std::min(text.size(), at + 1 + below(std::size_t{1} << below(8)))};
  const Span word = word_at(text, at);
  if (below(3) > 0) return word;
  if (below(2) == 0) return {word.begin, std::min(text.size(), word.end + below(60))};
  const std::size_t line = text.rfind('\n', at), end = text.find('\n', at);
  return {line == std::string_view::npos || line == at ? 0 : line + 1,
          end == std::string_view::npos ? text.size() : end + 1};
}

std::string Mutation::some_part(std::string_view from, bool text_form) {
  const Span span = some_span(from, text_form);
  return std::string(from.substr(span.begin, span.end - span.begin));
}

std::string Mutation::edge_word() {
  if (below(4) == 0) return std::to_string(static_cast<std::int64_t>(random_()) >> below(64));
  return std::string(kEdgeWords[below(kEdgeWords.size())]);
}

void Mutation::change_text(std::string& text, std::string_view other) {
  const Span span = some_span(text, true);
  const std::size_t length = span.end - span.begin;
  switch (below(9)) {
    case 0: text.erase(span.begin, length); break;
    case 1: text.insert(span.end, text.substr(span.begin, length)); break;
    case 2:
    case 3: text.replace(span.begin, length, some_part(other, true)); break;
    case 4: text.replace(span.begin, length, some_part(text, true)); break;
    case 5: text.insert(span.begin, some_part(other, true)); break;
    case 6: change_bytes(text, other); break;
    case 7:
      if (below(20) == 0 && length > 0)
        for (std::size_t copies = below(2000); copies > 0 && text.size() < kLongest; --copies)
          text.insert(span.begin, text.substr(span.begin, length));
      [[fallthrough]];
    default: text.replace(span.begin, length, edge_word());
  }
}

void Mutation::change_bytes(std::string& bytes, std::string_view other) {
  const Span span = some_span(bytes, false);
  const std::size_t length = span.end - span.begin;
  const auto byte = static_cast<char>(below(256));
  switch (below(8)) {
    case 0: bytes.erase(span.begin, length); break;
    case 1: bytes.insert(span.end, bytes.substr(span.begin, length)); break;
    case 2: bytes.insert(span.begin, some_part(other, false)); break;
    case 3: bytes.replace(span.begin, length, some_part(other, false)); break;
    case 4: bytes.insert(span.begin, 1 + below(8), byte); break;
    case 5:
      if (!bytes.empty()) bytes[span.begin] = static_cast<char>(bytes[span.begin] ^ (1 << below(8)));
      break;
    case 6:
      if (!bytes.empty()) bytes[span.begin] = static_cast<char>(bytes[span.begin] + static_cast<int>(below(9)) - 4);
      break;
    default:
      std::fill(bytes.begin() + static_cast<std::ptrdiff_t>(span.begin),
                bytes.begin() + static_cast<std::ptrdiff_t>(span.end), byte);
  }
}

}  // namespace mars::fuzz
