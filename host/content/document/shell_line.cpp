#include "host/content/document/shell_line.h"

#include <cctype>
#include <utility>

#include "hal/failure/failure.h"

namespace mars::document {
namespace {

class Splitter {
 public:
  void take(char letter) {
    const bool blank = std::isspace(static_cast<unsigned char>(letter)) != 0;
    if (escaped_) return keep_escaped(letter);
    if (letter == '\\' && quote_ != '\'') return void(escaped_ = true);
    if (letter == quote_) return void(quote_ = 0);
    if (quote_ == 0 && (letter == '\'' || letter == '"')) return begin_quote(letter);
    if (quote_ == 0 && blank) return end_word();
    keep(letter);
  }

  std::vector<std::string> end(const std::string& line) {
    if (quote_ != 0) throw Failure("the quotation mark " + std::string(1, quote_) + " is not closed", line, "close it");
    if (escaped_) throw Failure("a backslash is the last letter", line, "leave it out, or write two");
    end_word();
    return std::move(words_);
  }

 private:
  void keep(char letter) {
    begun_ = true;
    word_ += letter;
  }

  // Within "" a backslash stands for itself before other letters.
  void keep_escaped(char letter) {
    if (quote_ == '"' && letter != '"' && letter != '\\' && letter != '$' && letter != '`') keep('\\');
    keep(letter);
    escaped_ = false;
  }

  void begin_quote(char mark) {
    quote_ = mark;
    begun_ = true;
  }

  void end_word() {
    if (std::exchange(begun_, false)) words_.push_back(std::exchange(word_, ""));
  }

  std::vector<std::string> words_;
  std::string word_;
  bool begun_ = false;    // word_, which may be empty
  char quote_ = 0;        // that is open
  bool escaped_ = false;  // after a backslash
};

}  // namespace

std::vector<std::string> shell_words(const std::string& line) {
  Splitter splitter;
  for (const char letter : line) splitter.take(letter);
  return splitter.end(line);
}

}  // namespace mars::document
