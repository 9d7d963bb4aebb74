// Changes of inputs, from which the next are made.
#pragma once

#include <cstddef>
#include <random>
#include <string>
#include <string_view>

namespace mars::fuzz {

class Mutation {
 public:
  explicit Mutation(std::uint64_t seed) : random_(seed) {}

  // `text` with some words, numbers, lines or spans of them changed, also to those of `other`.
  std::string of_text(std::string_view text, std::string_view other);
  // `bytes` with some of them changed, also to some of `other`.
  std::string of_bytes(std::string_view bytes, std::string_view other);

  std::size_t below(std::size_t bound) { return bound == 0 ? 0 : random_() % bound; }

 private:
  struct Span {
    std::size_t begin, end;
  };

  Span word_at(std::string_view text, std::size_t at) const;
  Span some_span(std::string_view text, bool text_form);
  std::string some_part(std::string_view from, bool text_form);
  std::string edge_word();
  void change_text(std::string& text, std::string_view other);
  void change_bytes(std::string& bytes, std::string_view other);

  std::mt19937_64 random_;
};

}  // namespace mars::fuzz
