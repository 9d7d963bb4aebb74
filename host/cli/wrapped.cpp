#include "host/cli/wrapped.h"

#include <sstream>

namespace mars::cli {

std::string wrapped(const std::string& text, std::size_t indent, std::size_t columns) {
  const std::string margin(indent, ' ');
  std::string result;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (!result.empty()) result += "\n" + margin;
    std::size_t at = indent;
    std::istringstream words(line);
    for (std::string word; words >> word; at += word.size()) {
      if (at > indent && at + 1 + word.size() > columns) {
        result += "\n" + margin;
        at = indent;
      } else if (at > indent) {
        result += " ";
        ++at;
      }
      result += word;
    }
  }
  return result;
}

}  // namespace mars::cli
