// Commands that messages give, ready to be typed.
#pragma once

#include <string>

namespace mars::host {

// A name as a person types it in a command.
std::string shell_word(const std::string& name);

}  // namespace mars::host
