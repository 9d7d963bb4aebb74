#include "host/programs/film_of.h"

namespace mars::host {

CompiledFilm load_film_of(const RenderOptions& options) {
  CompileOptions compiling;
  if (options.intervals == Intervals::keyframes) compiling.cutting = Cutting::keyframes;
  if (options.size) compiling.size = {options.size->width, options.size->height};
  return load_film(options.film, compiling);
}

}  // namespace mars::host
