#include "host/shell/launch/text_reader.h"

#include <algorithm>
#include <charconv>

namespace mars::launch {
namespace {

constexpr std::string_view kTextSpace = " \t\r\n\v\f";

}  // namespace

bool TextReader::find(std::string_view words) {
  const std::size_t at = rest_.find(words);
  if (at == std::string_view::npos) return false;
  rest_.remove_prefix(at + words.size());
  return true;
}

bool TextReader::skip(std::string_view words) {
  if (!rest_.starts_with(words)) return false;
  rest_.remove_prefix(words.size());
  return true;
}

void TextReader::skip_space() { rest_.remove_prefix(std::min(rest_.find_first_not_of(kTextSpace), rest_.size())); }

std::optional<std::string> TextReader::word() {
  const std::string_view word = rest_.substr(0, rest_.find_first_of(kTextSpace));
  rest_.remove_prefix(word.size());
  if (word.size() > kLongestWord) return std::nullopt;
  return std::string(word);
}

std::optional<std::uint32_t> TextReader::number() {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
  if (error != std::errc()) return std::nullopt;
  rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
  return value;
}

std::optional<std::string> word_behind(std::string_view text, std::string_view words) {
  TextReader reader(text);
  if (!reader.find(words)) return std::nullopt;
  reader.skip_space();
  return reader.word();
}

std::string on_one_line(std::string_view text) {
  std::string line;
  for (const char c : text) {
    const bool space = kTextSpace.find(c) != std::string_view::npos;
    if (!space || (!line.empty() && line.back() != ' ')) line += space ? ' ' : c;
  }
  if (line.ends_with(' ')) line.pop_back();
  return line;
}

}  // namespace mars::launch
