#include "host/content/importer/joint_names.h"

#include <cctype>

#include "host/content/document/text.h"

namespace mars::importer {
namespace {

// A name of a model for a name of any bytes.
std::string plain_name(const std::string& given) {
  std::string name = document::in_utf8(given);
  for (char& byte : name)
    if (byte == '/' || std::iscntrl(static_cast<unsigned char>(byte))) byte = '-';
  if (name.size() > kLongestJointName) {
    std::size_t end = kLongestJointName;
    while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xc0) == 0x80) --end;  // not within a letter
    name.resize(end);
  }
  return name.empty() ? "joint" : name;
}

}  // namespace

std::string JointNames::unused(const std::string& wanted) {
  const auto [known, is_new] = names_.try_emplace(plain_name(wanted), 2);
  if (is_new) return known->first;
  for (;;) {
    const std::string name = known->first + "-" + std::to_string(known->second++);
    if (names_.try_emplace(name, 2).second) return name;
  }
}

}  // namespace mars::importer
