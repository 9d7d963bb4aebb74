// What is predicted of a rendering, by a forecast of its frames as nodes' code counts them.
#pragma once

#include <string>

#include "host/experiments/platform.h"
#include "host/render/session/session.h"
#include "host/shell/options/render_options.h"

namespace mars::programs {

// On simulated machines.
void predict_on(const experiments::Platform& platform, session::RenderJob& job);

// Renders on this machine, as its host. What is predicted follows from what mars calibrate measured on a machine
// that was not too busy; else from what work
// costs on a typical machine, and groups are not chosen by that. Nothing is predicted of renderings that soon end. Or
// serves a studio, where the options say so.
void render_here(const options::RenderOptions& options, const std::string& backend);

}  // namespace mars::programs
