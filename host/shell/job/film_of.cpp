#include "host/shell/job/film_of.h"

#include "hal/failure/failure.h"
#include "host/content/animator/pose/check.h"
#include "host/content/animator/reading/read_film.h"
#include "host/content/film/film_file.h"
#include "host/content/film/panorama.h"

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

film::CompiledFilm load_with_warnings(const std::string& path, film::CompileOptions compiling,
                                      const film::FrameSet& frames, const Warn& warn) {
  if (film::is_compiled_film(path)) {
    compiling.in_file = frames != film::FrameSet();
    film::CompiledFilm film = film::load_film(path, compiling);
    if (film.actors == 0) warn(path + kNoActors);
    return film;
  }
  const animator::Film film = animator::read_film(path);
  if (film.actors.empty()) warn(path + kNoActors);
  for (const std::string& line : animator::warnings_of(film)) warn(line);
  compiling.in_file = frames.is_small_part(film.frames);
  return film::compile(film, compiling);
}

film::CompiledFilm load_as_written(const options::RenderOptions& options, const Warn& warn) {
  film::CompileOptions compiling;
  if (options.intervals == options::Intervals::keyframes) compiling.cutting = animator::Cutting::keyframes;
  if (options.size) compiling.size = {options.size->width, options.size->height};
  compiling.samples = options.samples;
  compiling.eye = options.eye;
  compiling.crop = options.crop;
  compiling.margin = options.margin;
  if (options.film == options::kTrialFilm)
    return film::compile(animator::read_film(document::Document(kTrial, options::kTrialFilm).root(), {}), compiling);
  return load_with_warnings(options.film, compiling, options.faces ? film::FrameSet() : options.frames, warn);
}

}  // namespace

film::CompiledFilm load_film_of(const options::RenderOptions& options, const Warn& warn) {
  film::CompiledFilm film = load_as_written(options, warn);
  const bool panorama = film::is_panorama(film.view());
  if (panorama) film::check_panorama(film);
  if (!options.faces) return film;
  if (!panorama) throw Failure("is no panorama, so it has no faces", options.film, "leave out --faces");
  return film::faces_of(film);
}

film::CompiledFilm load_drawn_film_of(options::RenderOptions& options, const Warn& warn) {
  film::CompiledFilm film = load_film_of(options, warn);
  if (!film::is_panorama(film.view())) return film;
  options = faces_of(options, film.view().settings().frames);
  return film::faces_of(film);
}

options::RenderOptions faces_of(options::RenderOptions options, std::uint32_t film_frames) {
  const std::vector<std::uint32_t> frames = options.frames.of_film(film_frames);
  options.faces = true;
  options.format = images::PictureFormat::exr;  // light, as nodes draw it
  options.compression = images::Compression::zip;
  options.name.clear();
  options.first_number = 0;
  options.videos.clear();
  options.frames = film::FrameSet();
  if (frames.size() < film_frames) options.frames = film::FrameSet(film::face_frames(frames, film_frames));
  return options;
}

}  // namespace mars::job
