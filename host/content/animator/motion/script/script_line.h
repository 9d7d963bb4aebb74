// The words of a script's line, taken from left to right. What does not fit is a Failure with file and line.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace mars::motion {

// Times that have names, in frames.
using Times = std::map<std::string, double>;

class ScriptLine {
 public:
  // `where` is file and line, for messages.
  ScriptLine(std::string_view text, std::string where);

  bool empty() const { return next_ == words_.size(); }
  const std::string& where() const { return where_; }
  bool next_is(std::string_view word) const { return !empty() && words_[next_] == word; }
  bool take_if(std::string_view word);
  // `what` says what is missing where the line has ended: "an actor".
  std::string take(const std::string& what);

  // "48", "1.5s", "midpoint + 12", "runtime / 2": frames; from left to right.
  double take_time(const Times& times, double rate);

  [[noreturn]] void refuse(const std::string& what, const std::string& remedy) const;

 private:
  double take_term(const Times& times, double rate);

  std::vector<std::string> words_;
  std::size_t next_ = 0;
  std::string where_;
};

}  // namespace mars::motion
