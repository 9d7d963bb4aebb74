// One job as a person sees it: its progress, why its nodes may not answer, and whether this machine sees the frames.
#pragma once

#include <string>
#include <vector>

#include "host/shell/launch/adviser.h"
#include "host/shell/launch/display.h"
#include "host/shell/launch/remains.h"
#include "host/shell/launch/slots.h"
#include "host/shell/launch/starting.h"
#include "host/shell/options/render_options.h"

namespace mars::launch {

// Returns when the job has ended. `machines`: to be used instead of the options'; none: the options'. Throws Failure
// where this machine is to make videos of frames that it does not see, and child::Stopped where a person stops it.
Remains show_job(const options::RenderOptions& options, const Starting& starting, const std::vector<Slots>& machines,
                 Display& display, const Adviser& adviser);

std::string elsewhere_text(const std::string& folder, const std::string& machine);

}  // namespace mars::launch
