// What a film is compiled from: the files that were read, by their content. While they stay as they were, the compiled
// film that a folder keeps is the one that would be compiled again.
#pragma once

#include <string>
#include <vector>

#include "host/content/document/recorded_reads.h"
#include "host/render/sinks/manifest.h"

namespace mars::resume {

// Absolute, so that it names the same file wherever a later run is started.
std::string source_path(const std::string& file);

// The film's own file first. None where a file has changed since it was read, or there are too many to be recorded.
std::vector<sinks::Source> sources_of(const std::string& film, const document::FileStamps& reads);

// Whether there are any, and all have the content that they had.
bool are_unchanged(const std::vector<sinks::Source>& sources);

}  // namespace mars::resume
