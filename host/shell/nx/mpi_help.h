// Open MPI's mpirun as a child whose words on standard error are made short: a block of help between lines of dashes
// becomes the one line that a person needs. Everything else that mpirun and the programs write passes at once.
#pragma once

#include <string>
#include <string_view>

#include "host/child/command.h"

namespace mars::nx_jobs {

// The text as it is shown. mpirun writes a block of help at once: only blocks that are whole in `text` are explained.
// Blocks that are not understood stay. `has_host`: rank 0 is the host, else it is node 0.
std::string explained(std::string_view text, bool has_host);

// The exit code of mpirun; 128 and the signal if one ended it.
int run_mpirun(const child::Command& command, bool has_host);

}  // namespace mars::nx_jobs
