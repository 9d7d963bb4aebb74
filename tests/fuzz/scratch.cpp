#include "tests/fuzz/scratch.h"

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include "hal/failure/failure.h"

namespace mars::fuzz {

namespace fs = std::filesystem;

Scratch::Scratch() {
  const fs::path memory = "/dev/shm";
  std::error_code none;
  std::string name = ((fs::is_directory(memory, none) ? memory : fs::temp_directory_path()) / "mars-fuzz-XXXXXX");
  check(mkdtemp(name.data()) != nullptr, "a folder for files can be made");
  path_ = name;
}

Scratch::~Scratch() {
  std::error_code none;
  fs::remove_all(path_, none);
}

fs::path Scratch::file(const std::string& name, std::string_view text) const {
  const fs::path path = path_ / name;
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
