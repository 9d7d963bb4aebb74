#include "host/content/film/film_json.h"

#include "hal/failure/failure.h"
#include "host/content/animator/reading/film_version.h"
#include "host/content/animator/reading/read_film.h"
#include "host/content/film/compile.h"
#include "host/content/film/film_file.h"

namespace mars::film {
namespace {

namespace fs = std::filesystem;

animator::Film meaning_of(const fs::path& path) {
  if (is_compiled_film(path))
    throw Failure("is compiled: it has matrices, no keys", path.string(), "name the film file that it was made from");
  return animator::read_film(path);
}

// `before` must outlive it.
std::function<void(const document::Element&)> check_beside(const fs::path& path, const animator::Film& before) {
  return [folder = path.parent_path(), &before](const document::Element& root) {
    animator::require_new_sound(root, before);
    check_camera_and_lights(animator::read_film(root, folder));
  };
}

}  // namespace

FilmFile open_film(const fs::path& path) {
  animator::Film film = meaning_of(path);
  return {document::read_json(path), std::move(film)};
}

void change_film(const fs::path& path, const std::function<void(document::Json&, const animator::Film&)>& change) {
  meaning_of(path);  // refuses a file of another kind by its name
  animator::Film before;
  document::change_json(
      path,
      [&](document::Json& json) {
        before = animator::read_film(path);
        change(json, before);
        animator::write_version(json);
      },
      check_beside(path, before));
}

void create_film(const fs::path& path, const document::Json& film) {
  if (fs::exists(path))
    throw Failure("is there already", path.string(),
                  "choose another name, or change it with mars film FILM set and add");
  const animator::Film none;
  document::write_json(path, film, check_beside(path, none));
}

std::string name_beside(const fs::path& film, const std::string& file) {
  if (!fs::exists(file)) {
    const fs::path other = film.parent_path() / file;
    throw Failure("there is no such model file", file,
                  fs::exists(other) ? "beside the film there is one: name it " + other.string() : "check its name");
  }
  const fs::path path = file;
  if (path.is_absolute()) return file;
  // Their folders are found through links, for ".." leads out of where a link leads.
  const fs::path folder = fs::weakly_canonical(fs::absolute(path).parent_path());
  return (folder / path.filename()).lexically_relative(fs::weakly_canonical(fs::absolute(film).parent_path())).string();
}

}  // namespace mars::film
