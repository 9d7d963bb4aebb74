// The source files that tests of the architecture scan, read once.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <utility>
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

inline std::vector<Source> read_sources() {
  namespace fs = std::filesystem;
  std::vector<Source> sources;
  const std::regex include(R"((?:^|\n)\s*#\s*include\s*[<"]([^>"]+)[>"])");
  for (const char* folder : {"hal", "host", "node", "topology"}) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(MARS_SOURCE_DIR) / folder)) {
      const std::string ending = entry.path().extension().string();
      if (ending != ".h" && ending != ".cpp") continue;
      Source source{fs::relative(entry.path(), MARS_SOURCE_DIR).generic_string(), {}, read(entry.path())};
      for (std::sregex_iterator i(source.text.begin(), source.text.end(), include), end; i != end; ++i)
        source.includes.push_back((*i)[1]);
      sources.push_back(std::move(source));
    }
  }
  return sources;
}

inline const std::vector<Source>& sources() {
  static const std::vector<Source> all = read_sources();
  return all;
}

}  // namespace mars::test
