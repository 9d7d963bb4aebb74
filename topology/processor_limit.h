// How many processors this process may use: those that it is bound to, and the time on them that control groups leave
// (docker --cpus, Kubernetes' limits, CPUQuota of systemd).
#pragma once

#include <filesystem>

namespace mars::topology {

// The least quota of processors' time of the process's control group and those above it, in whole processors, rounded
// up; 0: none. `root` is where proc/ and sys/ are.
int processor_limit(const std::filesystem::path& root = "/");

// At least 1.
int usable_processors();

}  // namespace mars::topology
