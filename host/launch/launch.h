// What `mars render` does: chooses a backend, starts the host and its nodes, shows how far they are, and
// turns whatever goes wrong into one message.
#pragma once

#include <filesystem>

#include "host/options/render_options.h"

namespace mars::host {

// Returns when all frames are where they belong. `self`: the running program's own file. Throws Failure where
// the run fails or is stopped; nothing it started runs on.
void launch_render(RenderOptions options, const std::filesystem::path& self);

}  // namespace mars::host
