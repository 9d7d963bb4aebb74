// The values in a page's message, checked.
#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "host/studio/project/project.h"

namespace mars::studio {

// All throw Failure where the message has no such thing, or it is out of range.
double number_in(const Json& message, const char* key, double lowest, double highest);
glm::dvec2 pair_in(const Json& message, const char* key);
glm::dvec2 pixel_in(const Json& message);  // "x" and "y"
std::string word_in(const Json& message, const char* key);
std::vector<std::string> words_in(const Json& message, const char* key);  // none where the key is missing
using document::flag_in;
bool has_key(const Json& message, const char* modifier);  // of the keyboard, in "keys"

// The place of a word among those that may stand there.
template <std::size_t count>
std::size_t choice_in(const Json& message, const char* key, const char* const (&words)[count]);

[[noreturn]] void refuse(const std::string& what, const char* key, const std::string& remedy);

template <std::size_t count>
std::size_t choice_in(const Json& message, const char* key, const char* const (&words)[count]) {
  const std::string word = word_in(message, key);
  std::string all;
  for (std::size_t i = 0; i < count; ++i) {
    if (word == words[i]) return i;
    all += (all.empty() ? "" : ", ") + std::string(words[i]);
  }
  refuse("is '" + word + "'", key, "one of: " + all);
}

}  // namespace mars::studio
