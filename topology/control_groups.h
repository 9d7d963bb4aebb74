// The control groups that limit the calling process: a Slurm job's, a container's; of version 1 and of version 2.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mars::topology {

// The folders of the group in which `controller` ("memory", "cpu") counts this process and of all groups above it, up
// to the mount. Some may not be there: in a container the group's path may be the machine's. `root` is where proc/ and
// sys/ are.
std::vector<std::filesystem::path> control_groups(const std::string& controller, const std::filesystem::path& root);

}  // namespace mars::topology
