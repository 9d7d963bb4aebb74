// What a person asks to see: a film file, a compiled film, or a model file alone, distinguished by what they hold.
#pragma once

#include <filesystem>
#include <optional>

#include "host/preview/wireframe.h"

namespace mars::preview {

struct Previewed {
  film::CompiledFilm film;                 // for the renderer
  Wireframe wireframe;                     // for everything else
  std::optional<animator::Film> source{};  // what `film` was compiled from; none of a .mars file
  bool is_model = false;                   // a model file alone, in a film made around it
};

// A model becomes the film of a turn around it. Throws Failure as the readers do.
Previewed load_previewed(const std::filesystem::path& path);

}  // namespace mars::preview
