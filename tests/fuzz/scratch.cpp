#include "tests/fuzz/scratch.h"

#include <fcntl.h>
#include <unistd.h>

#include "hal/failure/failure.h"

namespace mars::fuzz {

namespace fs = std::filesystem;

fs::path Scratch::file(const std::string& name, std::string_view text) const {
  const fs::path path = folder_ / name;
  const int number = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  check(number >= 0 && write(number, text.data(), text.size()) == static_cast<ssize_t>(text.size()),
        "a file can be written");
  close(number);
  return path;
}

const Scratch& scratch() {
  static const Scratch own;
  return own;
}

}  // namespace mars::fuzz
