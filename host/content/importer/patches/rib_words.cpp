#include "host/content/importer/patches/rib_words.h"

#include <algorithm>
#include <cctype>

#include "hal/failure/failure.h"
#include "host/content/document/text.h"
#include "host/content/importer/patches/patch_scene.h"

namespace mars::importer {
namespace {

bool begins_request(char c) { return std::isalpha(static_cast<unsigned char>(c)); }

}  // namespace

void RibWords::refuse(const std::string& problem, const std::string& remedy) const {
  throw Failure(problem, name_ + ":" + std::to_string(line_), remedy);
}

void RibWords::skip() {
  while (!rest_.empty()) {
    if (rest_[0] == '#')
      rest_.remove_prefix(std::min(rest_.find('\n'), rest_.size()));
    else if (std::isspace(static_cast<unsigned char>(rest_[0])) || rest_[0] == ',')
      line_ += rest_[0] == '\n', rest_.remove_prefix(1);
    else
      return;
  }
}

std::string_view RibWords::bare_word() {
  const std::string_view word = rest_.substr(0, rest_.find_first_of(" \t\r\n\v\f,[]\"#"));
  rest_.remove_prefix(word.size());
  return word;
}

double RibWords::number() {
  if (!rest_.empty() && static_cast<unsigned char>(rest_[0]) >= 0x80)
    refuse("is a RIB file in bytes, which cannot be read",
           "write it as text: catrib -ascii, or RiOption \"rib\" \"format\"");
  const std::string word(bare_word());
  std::string digits = word.starts_with('+') ? word.substr(1) : word;
  if (const std::size_t sign = digits.starts_with('-'); digits.compare(sign, 1, ".") == 0) digits.insert(sign, "0");
  if (digits.ends_with('.')) digits += '0';
  const auto value = document::number_in<double>(digits);
  if (!value) refuse("has '" + document::printable(word, 40) + "' where a number should be", "write a number");
  return *value;
}

std::string RibWords::text() {
  rest_.remove_prefix(1);
  const std::size_t end = rest_.find('"');
  if (end == std::string_view::npos) refuse("has a text without an end", "end it with \"");
  std::string found(rest_.substr(0, end));
  line_ += static_cast<std::size_t>(std::ranges::count(found, '\n'));
  rest_.remove_prefix(end + 1);
  return found;
}

// Of numbers, or of one text, as some programs write them.
RibArgument RibWords::array() {
  rest_.remove_prefix(1);
  RibArgument all;
  for (skip(); !rest_.starts_with(']'); skip()) {
    if (rest_.empty()) refuse("ends within [ ]", "the file may be cut short");
    if (rest_[0] == '"')
      all.text = text();
    else
      all.numbers.push_back(number());
    if (all.numbers.size() > kMostSceneNumbers) refuse(too_many_patches(), "import parts of it by themselves");
  }
  rest_.remove_prefix(1);
  return all;
}

std::optional<RibRequest> RibWords::next() {
  skip();
  if (rest_.empty()) return std::nullopt;
  if (!begins_request(rest_[0])) {
    if (static_cast<unsigned char>(rest_[0]) >= 0x80) number();
    refuse("has '" + document::printable(std::string(bare_word().substr(0, 40)), 40) + "' where a request should be",
           "check what stands before it");
  }
  RibRequest request{std::string(bare_word()), {}, line_};
  for (skip(); !rest_.empty() && !begins_request(rest_[0]); skip()) {
    if (rest_[0] == '[')
      request.arguments.push_back(array());
    else if (rest_[0] == '"')
      request.arguments.push_back({text(), {}});
    else
      request.arguments.push_back({std::nullopt, {number()}});
  }
  return request;
}

}  // namespace mars::importer
