// The film that a person's options name, compiled as they say.
#pragma once

#include "host/film/compile.h"
#include "host/options/render_options.h"

namespace mars::host {

CompiledFilm load_film_of(const RenderOptions& options);

}  // namespace mars::host
