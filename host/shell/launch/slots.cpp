#include "host/shell/launch/slots.h"

#include <unistd.h>

#include <array>

namespace mars::launch {

bool is_here(const std::string& machine) {
  std::array<char, 256> host{};
  gethostname(host.data(), host.size() - 1);
  const std::string own = host.data();
  const auto short_name = [](const std::string& name) { return name.substr(0, name.find('.')); };
  return machine == "localhost" || machine.starts_with("127.") || short_name(machine) == short_name(own);
}

}  // namespace mars::launch
