#include "host/content/animator/motion/script/script_line.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "hal/failure/failure.h"
#include "host/content/document/fields.h"

namespace mars::motion {
namespace {

constexpr std::string_view kOperators = "+-*/";

bool blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

bool no_text(char c) { return std::iscntrl(static_cast<unsigned char>(c)) && !blank(c); }

}  // namespace

ScriptLine::ScriptLine(std::string_view text, std::string where) : where_(std::move(where)) {
  if (std::any_of(text.begin(), text.end(), no_text))
    refuse("holds control characters", "is it a script? Write plain text");
  for (std::size_t i = 0; i < text.size();) {
    if (blank(text[i])) {
      ++i;
    } else if (text[i] == '#') {
      break;
    } else if (text[i] == '"') {
      const std::size_t end = text.find('"', i + 1);
      if (end == std::string_view::npos) refuse("has a quote that does not end", "write \"front door\"");
      words_.emplace_back(text.substr(i + 1, end - i - 1));
      i = end + 1;
    } else {
      const std::size_t start = i;
      while (i < text.size() && !blank(text[i]) && text[i] != '#') ++i;
      words_.emplace_back(text.substr(start, i - start));
    }
  }
}

bool ScriptLine::take_if(std::string_view word) {
  if (!next_is(word)) return false;
  ++next_;
  return true;
}

std::string ScriptLine::take(const std::string& what) {
  if (empty()) refuse("ends where " + what + " is missing", "write it, or take the line out");
  return words_[next_++];
}

double ScriptLine::take_term(const Times& times, double rate) {
  const std::string word = take("a time");
  double number = 0;
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, number);
  if (error == std::errc() && std::isfinite(number) && (stop == end || (*stop == 's' && stop + 1 == end)))
    return stop == end ? number : number * rate;
  if (const auto found = times.find(word); found != times.end()) return found->second;
  std::vector<std::string_view> names;
  for (const auto& [name, time] : times) names.push_back(name);
  refuse("has '" + word + "', which is no time",
         document::did_you_mean(word, names, "write a frame, seconds as in 1.5s, or a name from a line 'let'"));
}

double ScriptLine::take_time(const Times& times, double rate) {
  double time = take_term(times, rate);
  while (!empty() && words_[next_].size() == 1 && kOperators.find(words_[next_][0]) != std::string_view::npos) {
    const char what = words_[next_++][0];
    const double other = take_term(times, rate);
    time = what == '+' ? time + other : what == '-' ? time - other : what == '*' ? time * other : time / other;
  }
  if (!(time >= 0) || time > 1e6) refuse("has a time before frame 0 or after 1000000", "write another");
  return time;
}

void ScriptLine::refuse(const std::string& what, const std::string& remedy) const {
  throw Failure("this line " + what, where_, remedy);
}

}  // namespace mars::motion
