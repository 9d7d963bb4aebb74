#include "topology/control_groups.h"

#include <fstream>
#include <sstream>

namespace mars::topology {
namespace {

namespace fs = std::filesystem;

void add_upwards(std::vector<fs::path>& groups, const fs::path& mount, fs::path group) {
  for (; group.has_relative_path(); group = group.parent_path()) groups.push_back(mount / group.relative_path());
  groups.push_back(mount);
}

bool has_word(const std::string& list, const std::string& word) {
  return ("," + list + ",").find("," + word + ",") != std::string::npos;
}

}  // namespace

// Lines of /proc/self/cgroup are number:controllers:path; version 2 has no controllers.
std::vector<fs::path> control_groups(const std::string& controller, const fs::path& root) {
  const fs::path mounts = root / "sys/fs/cgroup";
  std::ifstream lines(root / "proc/self/cgroup");
  std::vector<fs::path> groups;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream parts(line);
    std::string number, controllers, path;
    std::getline(std::getline(std::getline(parts, number, ':'), controllers, ':'), path);
    if (controllers.empty()) add_upwards(groups, mounts, path);
    if (has_word(controllers, controller)) add_upwards(groups, mounts / controller, path);
  }
  return groups;
}

}  // namespace mars::topology
