// The environment as lines "NAME=value": our own, to be passed on to what we start with some lines more.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mars::host {

class Environment {
 public:
  explicit Environment(std::vector<std::string> lines) : lines_(std::move(lines)) {}

  std::optional<std::string> value(std::string_view name) const;
  void set(const std::string& name, const std::string& value);
  // For exec; valid as long as this and unchanged.
  std::vector<char*> pointers();

 private:
  std::vector<std::string> lines_;
};

Environment own_environment();

// Where temporary files go, as Open MPI looks for it.
std::string temporary_folder(const Environment& environment);

}  // namespace mars::host
