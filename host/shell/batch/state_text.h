// The state of a folder of frames as texts for programs.
#pragma once

#include <string>

#include "host/shell/batch/folder_state.h"

namespace mars::batch {

// One JSON object (docs/watching.md names its keys), with its line's end.
std::string json_of(const FolderState& state);

// Metrics as OpenMetrics text, which also a textfile collector of Prometheus reads.
std::string metrics_of(const FolderState& state);

// One line for the comment of a batch job, without quotation marks.
std::string comment_of(const FolderState& state);

}  // namespace mars::batch
