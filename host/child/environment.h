// The environment as lines "NAME=value": our own, to be passed on to what we start with some lines more.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mars::child {

// For exec: valid as long as the lines and these unchanged.
std::vector<char*> pointers_to(std::vector<std::string>& lines);

class Environment {
 public:
  explicit Environment(std::vector<std::string> lines) : lines_(std::move(lines)) {}

  std::optional<std::string> value(std::string_view name) const;
  void set(const std::string& name, const std::string& value);
  std::vector<char*> pointers() { return pointers_to(lines_); }

 private:
  std::vector<std::string> lines_;
};

Environment own_environment();

// The folders in which programs are looked for: PATH, or the usual ones where it is not set.
std::string program_path(const Environment& environment);

// Where temporary files go, as Open MPI looks for it; a variable that is set but empty counts as not set.
std::string temporary_folder(const Environment& environment);

}  // namespace mars::child
