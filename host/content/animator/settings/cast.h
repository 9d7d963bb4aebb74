// A film's actors and the models that they use: added, removed, renamed. As values: `film` is the JSON of what
// read_film accepts, which also checks the result; it is as it was where these throw.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "host/content/document/json_file.h"

namespace mars::animator {

struct NewActor {
  std::string name;
  std::string
      model;  // one of the film's; a figure or object of the library; or a model file, seen from the film's folder
  std::optional<glm::dvec3> place{}, turn{};  // without a place it stands at the origin
  std::optional<double> height{};             // at rest, of what is of the library
};

// Neither a model that the film has nor one of the library.
bool is_model_file(const document::Json& film, const std::string& model);

// What is of the library becomes the film's own model, by its name; of a height of its own, by the actor's.
void add_actor(document::Json& film, const NewActor& actor);

// An actor of another film with its model and its keys, under a name of its own: the other film's actor of this name,
// or its only one. `rates`: this film's rate by the other one's, so that the keys keep their times (retime.h).
// `file_name`: how this film names a file that the other one names, as a model or within one. Returns the last frame of
// the keys; none: it has none.
std::optional<std::uint32_t> add_actor_of(document::Json& film, const document::Json& other, const std::string& name,
                                          double rates,
                                          const std::function<std::string(const std::string& file)>& file_name);

// Refuses where something is attached to it or the camera follows it. A model that nothing else uses goes too, unless
// it stands in this film alone.
void remove_actor(document::Json& film, const std::string& name);

// Also wherever the film names it.
void rename_actor(document::Json& film, const std::string& name, const std::string& new_name);

}  // namespace mars::animator
