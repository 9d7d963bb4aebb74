#include "host/child/environment.h"

#include <unistd.h>

#include <algorithm>

namespace mars::child {

std::vector<char*> pointers_to(std::vector<std::string>& lines) {
  std::vector<char*> pointers;
  for (std::string& line : lines) pointers.push_back(line.data());
  pointers.push_back(nullptr);
  return pointers;
}

std::optional<std::string> Environment::value(std::string_view name) const {
  for (const std::string& line : lines_) {
    if (line.size() > name.size() && line[name.size()] == '=' && line.starts_with(name)) {
      return line.substr(name.size() + 1);
    }
  }
  return std::nullopt;
}

void Environment::set(const std::string& name, const std::string& value) {
  std::erase_if(lines_, [&](const std::string& line) { return line.starts_with(name + "="); });
  lines_.push_back(name + "=" + value);
}

Environment own_environment() {
  std::vector<std::string> lines;
  for (char** line = environ; line != nullptr && *line != nullptr; ++line) lines.emplace_back(*line);
  return Environment(std::move(lines));
}

std::string program_path(const Environment& environment) { return environment.value("PATH").value_or("/usr/bin:/bin"); }

std::string temporary_folder(const Environment& environment) {
  for (const char* name : {"TMPDIR", "TEMP", "TMP"})
    if (const auto value = environment.value(name); value && !value->empty()) return *value;
  return "/tmp";
}

}  // namespace mars::child
