// A folder for the files that a target's readers read, in memory where the system has such; removed when the process
// ends well.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace mars::fuzz {

class Scratch {
 public:
  Scratch();
  ~Scratch();
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  std::filesystem::path path(const std::string& name) const { return path_ / name; }
  // Writes the file, and returns its path.
  std::filesystem::path file(const std::string& name, std::string_view text) const;

 private:
  std::filesystem::path path_;
};

// The process's own.
const Scratch& scratch();

}  // namespace mars::fuzz
