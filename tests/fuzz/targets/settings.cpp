// Settings of the environment: lines of NAME=VALUE.
#include <stdlib.h>

#include <string>

#include "hal/messages/settings.h"
#include "tests/fuzz/target.h"

namespace mars::fuzz::settings {

void take(std::string_view input) {
  clearenv();
  while (!input.empty()) {
    const std::size_t end = std::min(input.find('\n'), input.size());
    const std::string line(input.substr(0, end));
    const std::size_t equals = std::min(line.find('='), line.size());
    const std::string value = line.substr(std::min(equals + 1, line.size()));
    if (equals > 0) setenv(line.substr(0, equals).c_str(), value.c_str(), 1);
    input.remove_prefix(std::min(end + 1, input.size()));
  }
  messages::unknown_settings();
  messages::terminal_kind();
  messages::take_place_text();
  messages::read_settings();
}

const Target target("settings", Form::text, take);

}  // namespace mars::fuzz::settings
