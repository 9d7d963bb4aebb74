// Names of joints from names of other programs.
#pragma once

#include <map>
#include <string>

namespace mars::importer {

class JointNames {
 public:
  // A name that a model can have and that this has not given before: of at most 90 bytes, numbered where it must be,
  // without '/' and control characters. "joint" for "".
  std::string unused(const std::string& wanted);

 private:
  std::map<std::string, int> names_;  // and with which number another of the name would go on
};

}  // namespace mars::importer
