// Names of joints from names of other programs.
#pragma once

#include <cstddef>
#include <map>
#include <string>

namespace mars::importer {

inline constexpr std::size_t kLongestJointName = 90;  // of a name's 100 bytes: numbers may follow

class JointNames {
 public:
  // A name that a model can have and that this has not given before: of at most 90 bytes, in UTF-8, numbered where it
  // must be, without '/' and control characters. "joint" for "".
  std::string unused(const std::string& wanted);

 private:
  std::map<std::string, int> names_;  // and with which number another of the name would go on
};

}  // namespace mars::importer
