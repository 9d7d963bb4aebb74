// Follows what goes on in a folder until nothing does.
#pragma once

#include <filesystem>

namespace mars::batch {

// On a terminal lines that keep up with it; in a pipe or file each line that is new. Returns whether all frames are
// there.
bool follow(const std::filesystem::path& folder);

// Ends the jobs that were submitted for the folder, and returns when they have ended. Throws Failure where none
// was submitted, or one does not end.
void cancel(const std::filesystem::path& folder);

}  // namespace mars::batch
