#include "topology/debugger.h"

#include <fstream>
#include <string>

namespace mars::topology {

bool is_traced(std::int32_t process, const std::filesystem::path& root) {
  std::ifstream status(root / "proc" / std::to_string(process) / "status");
  std::string name;
  for (std::string line; status >> name && std::getline(status, line);)
    if (name == "TracerPid:") return std::stol(line) != 0;
  return false;
}

}  // namespace mars::topology
