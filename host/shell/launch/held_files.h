// Files that living processes of this machine have open or in memory.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace mars::launch {

// The paths that have one of `parts` in them, of the processes that this one sees and may look into: its user's.
std::vector<std::string> held_files(std::initializer_list<std::string_view> parts);

}  // namespace mars::launch
