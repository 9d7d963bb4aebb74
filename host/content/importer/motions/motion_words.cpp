#include "host/content/importer/motions/motion_words.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "hal/failure/failure.h"
#include "host/content/document/fields.h"
#include "host/content/document/text.h"

namespace mars::importer {
namespace {

constexpr std::string_view kBlanks = " \t\r\v\f";
constexpr const char* kCutShort = "the file may be cut short: export it again";

}  // namespace

bool same_word(std::string_view one, std::string_view other) {
  return std::ranges::equal(one, other,
                            [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); });
}

MotionWords::MotionWords(std::string_view text, std::string file, std::string_view marks)
    : rest_(text), file_(std::move(file)), marks_(marks) {
  if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);  // a byte order mark
}

void MotionWords::skip_blanks() { rest_.remove_prefix(std::min(rest_.find_first_not_of(kBlanks), rest_.size())); }

void MotionWords::skip_space() {
  for (skip_blanks(); rest_.starts_with('\n'); skip_blanks()) {
    ++line_;
    rest_.remove_prefix(1);
  }
}

bool MotionWords::at_end() {
  skip_space();
  return rest_.empty();
}

bool MotionWords::at_line_end() {
  skip_blanks();
  return rest_.empty() || rest_.front() == '\n';
}

std::string_view MotionWords::peek() {
  if (at_end()) return "";
  if (marks_.find(rest_.front()) != std::string_view::npos) return rest_.substr(0, 1);
  const auto ends = [&](char c) {
    return std::isspace(static_cast<unsigned char>(c)) || marks_.find(c) != std::string_view::npos;
  };
  return {rest_.begin(), std::ranges::find_if(rest_, ends)};
}

std::string_view MotionWords::next(const char* of) {
  const std::string_view word = peek();
  if (word.empty()) fail(std::string("ends before ") + of, kCutShort);
  rest_.remove_prefix(word.size());
  return word;
}

std::string_view MotionWords::rest_of_line() {
  skip_blanks();
  std::string_view line = rest_.substr(0, std::min(rest_.find('\n'), rest_.size()));
  rest_.remove_prefix(line.size());
  while (!line.empty() && std::isspace(static_cast<unsigned char>(line.back()))) line.remove_suffix(1);
  return line;
}

void MotionWords::skip_line() { rest_.remove_prefix(std::min(rest_.find('\n'), rest_.size())); }

bool MotionWords::takes(std::string_view word) {
  const std::string_view found = peek();
  if (!same_word(found, word)) return false;
  rest_.remove_prefix(found.size());
  return true;
}

void MotionWords::expect(std::string_view word, const char* where) {
  const std::string_view found = peek();
  if (takes(word)) return;
  if (found.empty()) fail(std::string("ends before '") + std::string(word) + "' " + where, kCutShort);
  fail("has '" + document::printable(found) + "' instead of '" + std::string(word) + "' " + where,
       "export the file again");
}

double MotionWords::number(const char* of) {
  std::string_view word = next(of);
  const std::string shown = document::printable(word);
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto value = document::number_in<double>(word);
  if (!value || !std::isfinite(*value)) fail("has '" + shown + "' for " + of, "write a number");
  if (std::abs(*value) > document::kFarthest) fail("has " + shown + " for " + of, "numbers are at most 1e9");
  return *value;
}

std::size_t MotionWords::whole_number(const char* of) {
  const double value = number(of);
  if (!(value >= 0 && value == std::floor(value)))
    fail("has " + document::shown(value) + " for " + of, "write a whole number");
  return static_cast<std::size_t>(value);
}

void MotionWords::fail(const std::string& problem, const std::string& remedy) const {
  throw Failure(problem, file_ + ":" + std::to_string(line_), remedy);
}

}  // namespace mars::importer
