#include "host/shell/launch/held_files.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace mars::launch {
namespace {

namespace fs = std::filesystem;

bool is_process(const std::string& name) {
  return std::ranges::all_of(name, [](unsigned char letter) { return std::isdigit(letter) != 0; });
}

}  // namespace

// Descriptors are read before maps, because a process may map a file and then close the descriptor.
std::vector<std::string> held_files(std::initializer_list<std::string_view> parts) {
  std::vector<std::string> held;
  const auto take = [&](std::string path) {
    const bool wanted = std::ranges::any_of(parts, [&](auto part) { return path.find(part) != std::string::npos; });
    if (wanted) held.push_back(std::move(path));
  };
  std::error_code error, ignored;  // a process ends meanwhile, or is another user's
  for (fs::directory_iterator process("/proc", error), end; !error && process != end; process.increment(error)) {
    if (!is_process(process->path().filename())) continue;
    for (fs::directory_iterator file(process->path() / "fd", ignored), last; !ignored && file != last;
         file.increment(ignored)) {
      std::error_code closed;
      take(fs::read_symlink(file->path(), closed));
    }
    std::ifstream maps(process->path() / "maps");
    for (std::string line; std::getline(maps, line);)
      if (const std::size_t path = line.find('/'); path != std::string::npos) take(line.substr(path));
  }
  return held;
}

}  // namespace mars::launch
