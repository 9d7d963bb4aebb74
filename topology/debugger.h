// Whether a process is in the hands of a debugger, or of another program that traces it: it may stand still then for as
// long as a person looks at it.
#pragma once

#include <cstdint>
#include <filesystem>

namespace mars::topology {

// Of this machine. False where it cannot be seen. `root` is where proc/ is.
bool is_traced(std::int32_t process, const std::filesystem::path& root = "/");

}  // namespace mars::topology
