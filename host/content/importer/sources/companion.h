// Files that an imported file names, which lie in its folder or below: a file of somebody else must not have others
// read.
#pragma once

#include <filesystem>
#include <string>

namespace mars::importer {

// Whether `name`, as the file names it, is relative and leads nowhere above.
bool stays_inside(const std::filesystem::path& name);

// Where the file is that `file` names. Refuses what does not stay inside, as by a link that leads out.
std::filesystem::path companion(const std::filesystem::path& file, const std::string& name);

}  // namespace mars::importer
