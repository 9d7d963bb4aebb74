// What the host's rank does from a person's options to the last frame: the same in every program that renders.
#pragma once

#include "host/shell/options/render_options.h"

namespace mars::host {

// Runs the calling HAL process as the host; reports events on standard output. `backend` is its name. A failure
// is reported as a fault event, and thrown for the caller, which ends the run.
void run_render_job(const RenderOptions& options, const char* backend);

}  // namespace mars::host
