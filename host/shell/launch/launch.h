// What `mars render` does: chooses a backend, starts the host and its nodes, shows how far they are, and
// turns whatever goes wrong into one message. And the same start with a tiny film, to see whether it works.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "hal/failure/failure.h"
#include "host/render/events/events.h"
#include "host/shell/launch/adviser.h"
#include "host/shell/launch/diagnosis.h"
#include "host/shell/options/render_options.h"

namespace mars::launch {

// Returns when all frames are where they belong. `self`: the running program's own file. Throws Failure where
// the run fails or is stopped; nothing it started runs on.
void launch_render(options::RenderOptions options, const std::filesystem::path& self, const Adviser& adviser);

// A start as launch_render's, of the film kTrialFilm.
struct Trial {
  std::string command;  // as it can be typed
  double boot_seconds = 0;
  events::Booted booted;  // no nodes: it did not come so far
  std::uint32_t frames = 0;
  std::optional<Failure> failure;
};

// Shows nothing; the number of nodes and the backend are those of `options`. Throws Failure where there is
// nothing to start.
Trial try_start(options::RenderOptions options, const std::filesystem::path& self);

}  // namespace mars::launch
