// A film's settings, camera, lights and materials. As values: `film` is the JSON of what read_film accepts, and made
// `meaning` of; it also checks the result. What is given is an object of values of keys, as a film file writes them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "host/content/animator/pose/film.h"
#include "host/content/document/json_file.h"

namespace mars::animator {

// A film of two seconds without actors; its camera sees a figure of the library that stands at the origin, from before
// its right.
document::Json new_film();

void set_film(document::Json& film, const document::Json& settings);
// What the camera has at all frames.
void set_camera(document::Json& film, const document::Json& settings);

// The lights of a film without any, and their ambient light, become its own.
void write_rig(document::Json& film, const Film& meaning);
// The same of a new film, to be written to `path`; the first of the lights, the brightest, casts shadows as the sun
// does.
void light_new_film(document::Json& film, const std::filesystem::path& path);
// Its number, from 1. A film without lights of its own gets those first that it was shown with.
std::size_t add_light(document::Json& film, const Film& meaning, const document::Json& light);
// What the light has at all frames.
void set_light(document::Json& film, const Film& meaning, std::size_t number, const document::Json& settings);
void remove_light(document::Json& film, const Film& meaning, std::size_t number);

// With an actor, that one wears it: where its model's material of this name is, which it begins as, else all over.
void add_material(document::Json& film, const Film& meaning, const std::string& name, const document::Json& values,
                  const std::string& actor);
void set_material(document::Json& film, const std::string& name, const document::Json& values);
// Actors that wore it wear what their models give them.
void remove_material(document::Json& film, const std::string& name);

}  // namespace mars::animator
