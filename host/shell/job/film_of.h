// The film that a person's options name, compiled as they say.
#pragma once

#include <functional>
#include <string>

#include "host/content/film/compile.h"
#include "host/shell/options/render_options.h"

namespace mars::job {

// Takes one line about a probable mistake in the film.
using Warn = std::function<void(const std::string& line)>;

// `warn` is called before the film's motion is computed, as that may take long; of a .mars file, which has no keys,
// it learns only whether anybody acts.
film::CompiledFilm load_film_of(const options::RenderOptions& options, const Warn& warn);

}  // namespace mars::job
