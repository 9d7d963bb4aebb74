#include "host/content/document/text_lines.h"

#include <algorithm>
#include <span>

#include "hal/failure/plain_text.h"
#include "host/content/document/text.h"

namespace mars::document {
namespace {

using Characters = std::vector<std::string_view>;

constexpr std::string_view kMore = "...";

// Of plain text.
Characters characters_of(std::string_view text) {
  const auto continues = [](char byte) { return (static_cast<unsigned char>(byte) & 0xc0) == 0x80; };
  Characters characters;
  while (!text.empty()) {
    const auto next = std::find_if_not(text.begin() + 1, text.end(), continues);
    characters.push_back(text.substr(0, static_cast<std::size_t>(next - text.begin())));
    text.remove_prefix(characters.back().size());
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
  const std::string plain = plain_line(text);
  const Characters characters = characters_of(plain);
  return joined(std::span(characters).first(std::min(columns, characters.size())), "");
}

std::vector<std::string> wrapped(std::string_view text, std::size_t columns, std::size_t lines) {
  const std::string plain = plain_line(text);
  const Characters characters = characters_of(plain);
  std::vector<std::string> result;
  for (std::span rest(characters); !rest.empty();) {
    if (result.size() + 1 == lines && rest.size() > columns) {
      result.push_back(joined(rest.first(columns - std::min(columns, kMore.size())), ""));
      result.back() += kMore.substr(0, columns);
      break;
    }
    const std::size_t length = line_length(rest, columns);
    result.push_back(joined(rest.first(length), ""));
    rest = rest.subspan(length);
    if (!rest.empty() && rest.front() == " ") rest = rest.subspan(1);
  }
  return result;
}

}  // namespace mars::document
