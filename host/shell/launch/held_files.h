// Files that living processes of this machine have open or in memory.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace mars::launch {

// The paths that have `part` in them, of the processes that this one may look into: its user's.
std::vector<std::string> held_files(std::string_view part);

}  // namespace mars::launch
