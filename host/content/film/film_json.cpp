#include "host/content/film/film_json.h"

#include "hal/failure/failure.h"
#include "host/content/animator/read_film.h"
#include "host/content/film/compile.h"
#include "host/content/film/film_file.h"

namespace mars::host {
namespace {

Film meaning_of(const std::filesystem::path& path) {
  if (is_compiled_film(path))
    throw Failure("is compiled: it has matrices, no keys", path.string(),
                  "name the film file that it was made from");
  return read_film(path);
}

}  // namespace

FilmFile open_film(const std::filesystem::path& path) {
  Film film = meaning_of(path);
  return {read_json(path), std::move(film)};
}

void change_film(const std::filesystem::path& path, const std::function<void(Json&, const Film&)>& change) {
  meaning_of(path);  // refuses a file of another kind by its name
  change_json(
      path, [&](Json& json) { change(json, read_film(path)); },
      [&](const Element& root) { check_camera(read_film(root, path.parent_path())); });
}

}  // namespace mars::host
