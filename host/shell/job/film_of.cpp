#include "host/shell/job/film_of.h"

#include "host/content/animator/pose/check.h"
#include "host/content/animator/reading/read_film.h"
#include "host/content/film/film_file.h"

namespace mars::job {
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

constexpr const char* kNoActors = ": has no actors: every frame shows the background alone (give the film actors)";

film::CompiledFilm load_with_warnings(const std::string& path, const film::CompileOptions& compiling,
                                      const Warn& warn) {
  if (film::is_compiled_film(path)) {
    film::CompiledFilm film = film::load_film(path, compiling);
    if (film.actors == 0) warn(path + kNoActors);
    return film;
  }
  const animator::Film film = animator::read_film(path);
  if (film.actors.empty()) warn(path + kNoActors);
  for (const std::string& line : animator::warnings_of(film)) warn(line);
  return film::compile(film, compiling);
}

}  // namespace

film::CompiledFilm load_film_of(const options::RenderOptions& options, const Warn& warn) {
  film::CompileOptions compiling;
  if (options.intervals == options::Intervals::keyframes) compiling.cutting = animator::Cutting::keyframes;
  if (options.size) compiling.size = {options.size->width, options.size->height};
  compiling.samples = options.samples;
  compiling.eye = options.eye;
  compiling.crop = options.crop;
  compiling.margin = options.margin;
  if (options.film == options::kTrialFilm)
    return film::compile(animator::read_film(document::Document(kTrial, options::kTrialFilm).root(), {}), compiling);
  return load_with_warnings(options.film, compiling, warn);
}

}  // namespace mars::job
