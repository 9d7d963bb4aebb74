// The film that a person's options name, compiled as they say.
//
// A panorama (host/content/film/panorama.h) is compiled as it is; what is drawn of it is its film of faces, --faces.
#pragma once

#include <cstdint>
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

// The same for those who draw it, or forecast that: of a panorama its film of faces, whose frames `frames` becomes.
film::CompiledFilm load_drawn_film_of(options::RenderOptions& options, const Warn& warn);

// The options by which the film of faces is drawn of the panorama of `film_frames` that the options name.
options::RenderOptions faces_of(options::RenderOptions options, std::uint32_t film_frames);

}  // namespace mars::job
