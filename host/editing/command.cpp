#include "host/editing/command.h"

#include <sstream>

namespace mars::editing {

std::vector<std::string> Done::lines() const {
  std::vector<std::string> all = remarks;
  std::istringstream rest(report);
  for (std::string line; std::getline(rest, line);) all.push_back(line);
  return all;
}

}  // namespace mars::editing
