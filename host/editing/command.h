// A command as words, and what it says.
#pragma once

#include <string>
#include <vector>

namespace mars::editing {

// Words after `mars`, without the film: {"animate", "walk", "tom", "--to", "2", "0"}.
using Command = std::vector<std::string>;

// For the person.
struct Done {
  std::vector<std::string> remarks;
  std::string report;

  std::vector<std::string> lines() const;  // of both
};

}  // namespace mars::editing
