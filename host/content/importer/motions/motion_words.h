// The words of a text file of motions (BVH, ASF, AMC), each with its line: what is wrong is one Failure at FILE:LINE.
#pragma once

#include <concepts>
#include <cstddef>
#include <string>
#include <string_view>

namespace mars::importer {

class MotionWords {
 public:
  // `text` must outlive it. Words end at white space and at the characters of `marks`, which are words themselves.
  MotionWords(std::string_view text, std::string file, std::string_view marks);
  MotionWords(std::same_as<std::string> auto&&, auto&&...) = delete;

  bool at_end();            // of the file
  bool at_line_end();       // of the line of the last word, or of the file
  std::string_view peek();  // the next word; "" at the end
  std::string_view next(const char* of);
  std::string_view rest_of_line();  // without white space around it
  void skip_line();

  // In capitals or not.
  bool takes(std::string_view word);
  void expect(std::string_view word, const char* where);

  double number(const char* of);  // finite, at most 1e9
  std::size_t whole_number(const char* of);

  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const;

 private:
  void skip_blanks();
  void skip_space();

  std::string_view rest_;
  std::string file_;
  std::string_view marks_;
  std::size_t line_ = 1;
};

// Whether both are one word but for capitals of ASCII.
bool same_word(std::string_view one, std::string_view other);

}  // namespace mars::importer
