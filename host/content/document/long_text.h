// Text of many megabytes in parts, so that nothing is copied where more is put before or behind it.
#pragma once

#include <string>
#include <vector>

namespace mars::document {

struct TextPart {
  std::string text;
  std::string brief{};  // stands for it where only what is around matters; empty: nothing does
};

using LongText = std::vector<TextPart>;

inline std::string brief_of(const LongText& text) {
  std::string all;
  for (const TextPart& part : text) all += part.brief.empty() ? part.text : part.brief;
  return all;
}

}  // namespace mars::document
