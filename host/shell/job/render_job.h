// From a person's options to the rendering they describe.
#pragma once

#include <string>

#include "host/render/session/session.h"
#include "host/shell/options/render_options.h"

namespace mars::job {

// `backend` is the name of the one that carries messages.
session::RenderJob job_of(const options::RenderOptions& options, const std::string& backend);

}  // namespace mars::job
