// A folder for the files that a target's readers read, in memory where the system has such; removed when the process
// ends well.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "tests/temporary_folder.h"

namespace mars::fuzz {

class Scratch {
 public:
  std::filesystem::path path(const std::string& name) const { return folder_ / name; }
  // Writes the file, and returns its path.
  std::filesystem::path file(const std::string& name, std::string_view text) const;

 private:
  const test::TemporaryFolder folder_{test::memory_folder()};
};

// The process's own.
const Scratch& scratch();

}  // namespace mars::fuzz
