// `mars preview` and `mars play`: films before they are rendered, and after.
#pragma once

#include <functional>
#include <memory>

#include "host/cli/command.h"
#include "host/content/film/compiled_film.h"
#include "host/preview/surface_source.h"

namespace mars::commands {

// Rendered frames of a film that outlives them.
using MakeSurface = std::function<std::unique_ptr<preview::SurfaceSource>(const film::CompiledFilm& film)>;

void add_preview(cli::Command app, const MakeSurface& make_surface);
void add_play(cli::Command app);

}  // namespace mars::commands
