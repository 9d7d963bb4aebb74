// What `mars animate FILM ...` and its kind do to a file, done to a film in memory: so that whatever the studio does, a
// command does, and both write the same file.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "host/content/document/json_file.h"

namespace mars::editing {

// Words after `mars`, without the film: {"animate", "walk", "tom", "--to", "2", "0"}.
using Command = std::vector<std::string>;

// For the person.
struct Done {
  std::vector<std::string> remarks;
  std::string report;
};

// Changes `film`, the JSON of the film at `path`, by all commands, or throws Failure: it is then as it was.
Done edit_film(document::Json& film, const std::filesystem::path& path, std::span<const Command> commands);

}  // namespace mars::editing
