// Reads what other programs wrote, from left to right and in time proportional to its length: any amount may come.
#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace mars::launch {

class TextReader {
 public:
  explicit TextReader(std::string_view text) : rest_(text) {}
  explicit TextReader(std::same_as<std::string> auto&&) = delete;

  bool at_end() const { return rest_.empty(); }
  // Goes behind the next occurrence of `words`; where there is none it stays.
  bool find(std::string_view words);
  // Goes behind `words` if they come next, else it stays.
  bool skip(std::string_view words);
  void skip_space();
  // What comes before the next white space; none for more than kLongestWord bytes, behind which it goes as well.
  std::optional<std::string> word();
  // The decimal number that comes next; none, also for one beyond 32 bits: it stays.
  std::optional<std::uint32_t> number();

  static constexpr std::size_t kLongestWord = 255;  // bytes; a host name has no more

 private:
  std::string_view rest_;
};

// The word behind the first `words` in `text` and white space.
std::optional<std::string> word_behind(std::string_view text, std::string_view words);

// With one blank for each run of white space, none at the ends: help texts are wrapped at any word.
std::string on_one_line(std::string_view text);

}  // namespace mars::launch
