#include "host/child/programs.h"

#include <unistd.h>

#include <algorithm>
#include <system_error>

namespace mars::child {

namespace fs = std::filesystem;

fs::path own_file() { return fs::read_symlink("/proc/self/exe"); }

bool runnable(const fs::path& file) {
  std::error_code ignored;
  return fs::is_regular_file(file, ignored) && access(file.c_str(), X_OK) == 0;
}

std::optional<fs::path> find_program(const std::string& name, const std::string& path) {
  const std::string_view only = name;
  return find_first_program({&only, 1}, path);
}

std::optional<fs::path> find_first_program(std::span<const std::string_view> names, std::string_view path) {
  while (!path.empty()) {
    const std::string_view folder = path.substr(0, path.find(':'));
    path.remove_prefix(std::min(path.size(), folder.size() + 1));
    for (const std::string_view name : names) {
      if (const fs::path file = fs::path(folder) / name; !folder.empty() && runnable(file)) return file;
    }
  }
  return std::nullopt;
}

}  // namespace mars::child
