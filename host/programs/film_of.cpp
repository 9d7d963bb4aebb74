#include "host/programs/film_of.h"

#include "host/animator/read_film.h"

namespace mars::host {
namespace {

// A box that turns over a table: something stands still, something moves.
constexpr const char* kTrial = R"({
  "frames": 4, "size": [64, 36], "camera": {"eye": [0, -6, 3], "at": [0, 0, 0]},
  "models": {
    "table": {"joints": [{"name": "top", "segment": {"shape": "box", "sbb": [[-2, -2, -1], [2, 2, -0.8]]}}]},
    "box": {"joints": [{"name": "side", "segment": {"shape": "box", "sbb": [[-0.5, -0.5, -0.5], [0.5, 0.5, 0.5]]}}]}},
  "actors": [{"name": "table", "model": "table"},
             {"name": "box", "model": "box", "keys": [{"frame": 0}, {"frame": 3, "turn": [0, 0, 90]}]}]
})";

}  // namespace

CompiledFilm load_film_of(const RenderOptions& options) {
  CompileOptions compiling;
  if (options.intervals == Intervals::keyframes) compiling.cutting = Cutting::keyframes;
  if (options.size) compiling.size = {options.size->width, options.size->height};
  if (options.film == kTrialFilm) return compile(read_film(Document(kTrial, kTrialFilm).root(), {}), compiling);
  return load_film(options.film, compiling);
}

}  // namespace mars::host
