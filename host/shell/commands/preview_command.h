// `mars preview` and `mars play`: films before they are rendered, and after.
#pragma once

#include <functional>
#include <memory>

#include "host/content/film/compiled_film.h"
#include "host/preview/surface_source.h"

namespace CLI {
class App;
}

namespace mars::commands {

// Rendered frames of a film that outlives them.
using MakeSurface = std::function<std::unique_ptr<preview::SurfaceSource>(const film::CompiledFilm& film)>;

void add_preview(CLI::App& app, const MakeSurface& make_surface);
void add_play(CLI::App& app);

}  // namespace mars::commands
