// The source files that tests of the architecture scan, read once.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

namespace mars::test {

struct Source {
  std::string path;  // from the root, with /
  std::vector<std::string> includes;
  std::string text;
};

inline std::string read(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// Regular expressions are slow: only the lines that may be includes are given to one.
inline std::vector<std::string> includes_in(const std::string& text) {
  static const std::regex include(R"(\s*#\s*include\s*[<"]([^>"]+)[>"].*)");
  std::vector<std::string> includes;
  std::smatch found;
  for (std::size_t at = text.find("include"); at != std::string::npos; at = text.find("include", at)) {
    const std::size_t begin = text.rfind('\n', at) + 1;
    at = std::min(text.find('\n', at), text.size());
    const std::string line = text.substr(begin, at - begin);
    if (std::regex_match(line, found, include)) includes.push_back(found[1]);
  }
  return includes;
}

inline std::vector<Source> read_sources() {
  namespace fs = std::filesystem;
  std::vector<Source> sources;
  for (const char* folder : {"hal", "host", "node", "topology"}) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(MARS_SOURCE_DIR) / folder)) {
      const std::string ending = entry.path().extension().string();
      if (ending != ".h" && ending != ".cpp") continue;
      std::string text = read(entry.path());
      sources.push_back({fs::relative(entry.path(), MARS_SOURCE_DIR).generic_string(), includes_in(text), text});
    }
  }
  return sources;
}

inline const std::vector<Source>& sources() {
  static const std::vector<Source> all = read_sources();
  return all;
}

}  // namespace mars::test
