#include "host/content/film/film_json.h"

#include "hal/failure/failure.h"
#include "host/content/animator/film_version.h"
#include "host/content/animator/read_film.h"
#include "host/content/film/compile.h"
#include "host/content/film/film_file.h"

namespace mars::film {
namespace {

animator::Film meaning_of(const std::filesystem::path& path) {
  if (is_compiled_film(path))
    throw Failure("is compiled: it has matrices, no keys", path.string(), "name the film file that it was made from");
  return animator::read_film(path);
}

std::function<void(const document::Element&)> check_beside(const std::filesystem::path& path) {
  return
      [folder = path.parent_path()](const document::Element& root) { check_camera(animator::read_film(root, folder)); };
}

}  // namespace

FilmFile open_film(const std::filesystem::path& path) {
  animator::Film film = meaning_of(path);
  return {document::read_json(path), std::move(film)};
}

void change_film(const std::filesystem::path& path,
                 const std::function<void(document::Json&, const animator::Film&)>& change) {
  meaning_of(path);  // refuses a file of another kind by its name
  document::change_json(
      path,
      [&](document::Json& json) {
        change(json, animator::read_film(path));
        animator::write_version(json);
      },
      check_beside(path));
}

void create_film(const std::filesystem::path& path, const document::Json& film) {
  if (std::filesystem::exists(path))
    throw Failure("is there already", path.string(),
                  "choose another name, or change it with mars film FILM set and add");
  document::write_json(path, film, check_beside(path));
}

}  // namespace mars::film
