#include "host/preview/text_lines.h"

#include <algorithm>
#include <span>

#include "host/content/document/text.h"

namespace mars::preview {
namespace {

using Characters = std::vector<std::string_view>;

constexpr std::string_view kMore = "...";

// Bytes of the character that `text` begins with, in UTF-8; what is none is one of one byte.
std::size_t length_of_first(std::string_view text) {
  const auto byte = [text](std::size_t at) { return at < text.size() ? static_cast<unsigned char>(text[at]) : 0u; };
  const std::size_t length = byte(0) < 0xc0 ? 1 : byte(0) < 0xe0 ? 2 : byte(0) < 0xf0 ? 3 : 4;
  for (std::size_t at = 1; at < length; ++at)
    if ((byte(at) & 0xc0) != 0x80) return 1;
  return length;
}

// Or no character. Of two bytes are U+0080 to U+009F.
bool is_control(std::string_view character) {
  const auto first = static_cast<unsigned char>(character[0]);
  if (character.size() == 1) return first < 0x20 || first >= 0x7f;
  return first == 0xc2 && static_cast<unsigned char>(character[1]) < 0xa0;
}

Characters characters_of(std::string_view text) {
  Characters characters;
  for (; !text.empty(); text.remove_prefix(length_of_first(text))) {
    const std::string_view character = text.substr(0, length_of_first(text));
    characters.push_back(is_control(character) ? "?" : character);
  }
  return characters;
}

// How many of `characters` a line takes.
std::size_t line_length(std::span<const std::string_view> characters, std::size_t columns) {
  if (characters.size() <= columns) return characters.size();
  for (std::size_t length = columns; length > 0; --length)
    if (characters[length] == " ") return length;
  return columns;
}

}  // namespace

std::string cut_to(std::string_view text, std::size_t columns) {
  const Characters characters = characters_of(text);
  return document::joined(std::span(characters).first(std::min(columns, characters.size())), "");
}

std::vector<std::string> wrapped(std::string_view text, std::size_t columns, std::size_t lines) {
  const Characters characters = characters_of(text);
  std::vector<std::string> result;
  for (std::span rest(characters); !rest.empty();) {
    if (result.size() + 1 == lines && rest.size() > columns) {
      result.push_back(document::joined(rest.first(columns - std::min(columns, kMore.size())), ""));
      result.back() += kMore.substr(0, columns);
      break;
    }
    const std::size_t length = line_length(rest, columns);
    result.push_back(document::joined(rest.first(length), ""));
    rest = rest.subspan(length);
    if (!rest.empty() && rest.front() == " ") rest = rest.subspan(1);
  }
  return result;
}

}  // namespace mars::preview
