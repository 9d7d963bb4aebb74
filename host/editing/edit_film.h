// What `mars animate FILM ...` and its kind do to a file, done to a film in memory: so that whatever the studio does, a
// command does, and both write the same file.
#pragma once

#include <filesystem>
#include <span>

#include "host/content/document/json_file.h"
#include "host/editing/command.h"

namespace mars::editing {

// Changes `film`, the JSON of the film at `path`, by all commands, or throws Failure: it is then as it was.
Done edit_film(document::Json& film, const std::filesystem::path& path, std::span<const Command> commands);

}  // namespace mars::editing
