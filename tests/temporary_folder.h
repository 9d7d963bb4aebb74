// A folder of its own for a test, removed with all it holds. No other process has a folder of the same name, so tests
// of several checkouts run side by side.
#pragma once

#include <errno.h>
#include <stdlib.h>

#include <cstdio>
#include <filesystem>
#include <iterator>
#include <string>
#include <system_error>

namespace mars::test {

// Where files lie in memory; where temporary files go, if the system has no such place.
inline std::filesystem::path memory_folder() {
  const std::filesystem::path memory = "/dev/shm";
  std::error_code none;
  return std::filesystem::is_directory(memory, none) ? memory : std::filesystem::temp_directory_path();
}

class TemporaryFolder {
 public:
  explicit TemporaryFolder(const std::filesystem::path& parent = std::filesystem::temp_directory_path()) {
    std::string name = (parent / "mars-test-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
      throw std::filesystem::filesystem_error("a test's folder cannot be made", parent,
                                              {errno, std::generic_category()});
    path_ = name;
  }
  // What cannot be removed, as a mount, is reported; an exception here would hide why the test failed. Programs without
  // GoogleTest have such folders, too.
  ~TemporaryFolder() {
    std::error_code failure;
    std::filesystem::remove_all(path_, failure);
    if (failure) std::fprintf(stderr, "a test's folder stays: %s: %s\n", path_.c_str(), failure.message().c_str());
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

  // How many files and folders it holds.
  std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(path_), {}));
  }

 private:
  std::filesystem::path path_;
};

}  // namespace mars::test
