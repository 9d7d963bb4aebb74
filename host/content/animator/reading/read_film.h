// Film files (docs/film-format.md): from JSON to a Film. Every name is resolved, every range and limit
// checked.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/content/animator/pose/film.h"
#include "host/content/document/fields.h"
#include "host/content/document/json_file.h"

namespace mars::animator {

// Model files are found beside the film file. The film's sound may be missing, for no frame needs it: videos and
// check_film() refuse it then.
Film read_film(const std::filesystem::path& path);
Film read_film(const document::Element& element, const std::filesystem::path& folder);

// Whether films of the two files have the same models, as long as nobody changes other files.
bool same_models(const document::Json& one, const document::Json& two);

// A film with the same models as one read before, whose `models` are not read again: they become the
// film's, or stay where they are if it throws.
Film read_film(const document::Element& element, std::vector<modeler::Model>& models);

// Refuses a sound that a change makes the film name, and that is no regular file. A sound that the film had `before`
// may be missing, so that the film can be repaired.
void require_new_sound(const document::Element& film, const Film& before);

// What of a film can change without the rest: the camera, all lights, all materials, an actor.
struct FilmPart {
  enum class Kind { camera, lights, materials, actor } kind;
  std::size_t actor = 0;  // its number

  bool operator==(const FilmPart&) const = default;
};

// Where a thing's keys are (things.h); none where the film has no such thing.
std::optional<FilmPart> part_of(const Film& film, const std::string& thing);

document::Json::json_pointer pointer_to(FilmPart part);

// Reads the part again, of a film that was read from `json` before the part changed there. The film is as if all were
// read; where it throws, the film is as it was, and the message lacks line and place: read all to get them.
void read_again(FilmPart part, const document::Json& json, Film& film);

}  // namespace mars::animator
