// What a page asks to import: the files that it is going to send, and what `mars import` makes of which.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "host/content/document/json_file.h"

namespace mars::studio {

using document::Json;

inline constexpr std::size_t kMostImportedFiles = 500;
inline constexpr std::uint64_t kMostImportedBytes = std::uint64_t{512} << 20;  // of one import's files together

struct ImportedFile {
  std::string name;  // plain: "tex/skin.png", below a folder of the import's own
  std::uint64_t bytes;
};

struct ImportRequest {
  std::vector<ImportedFile> files;
  std::vector<std::string> options;  // words of `mars import`: "--height=5.1"
};

// Of a message {"do": "import", "files": [{"name", "size"}], "options": {...}}. Throws Failure where a name is not
// plain, or comes twice, and where the files are too many or too long.
ImportRequest import_request(const Json& message);

// Of a message {"do": "import_more", "files"}: adds files to those that came. Throws Failure as import_request() does.
void add_files(ImportRequest& request, const Json& message);

// One run of `mars import`: of what it is run, and what the model or film that it makes is to be named.
struct ImportJob {
  std::string main;               // the name of a file
  std::vector<std::string> more;  // motions that follow it
  bool moves = false;             // it has a motion
  std::string name;               // "rock": of rock.json, and of an actor
};

// All files that are no companions of others have a job; motions of one skeleton share one. Throws Failure where no
// file can be imported.
std::vector<ImportJob> import_jobs(const std::vector<ImportedFile>& files);

}  // namespace mars::studio
