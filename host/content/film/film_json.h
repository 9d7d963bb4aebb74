// Film files as people write them, read with what they mean, and changed in place.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "host/content/animator/pose/film.h"
#include "host/content/document/json_file.h"

namespace mars::film {

struct FilmFile {
  document::Json json;
  animator::Film film;
};

// Refuses compiled films, and what read_film() refuses.
FilmFile open_film(const std::filesystem::path& path);

// Changes the film file, and its version where it needs a newer one (film_version.h); it stays as it was where `change`
// fails or the result is no film. Of several at a time no change is lost (change_json()).
void change_film(const std::filesystem::path& path,
                 const std::function<void(document::Json& json, const animator::Film& film)>& change);

// Writes a new film file. Refuses if there is one of this name.
void create_film(const std::filesystem::path& path, const document::Json& film);

// How the film names a model file that is there, which a person names as seen from the working folder: a relative name
// becomes one as seen from the film's folder.
std::string name_beside(const std::filesystem::path& film, const std::string& file);

}  // namespace mars::film
