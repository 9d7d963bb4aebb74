// The actions that a command or a line of a script starts: walk, turn, sit ... Each is an entry of one table,
// with its parameters, from which command line, scripts and help come.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/content/animator/edit.h"
#include "host/content/animator/film.h"
#include "host/content/document/fields.h"

namespace mars::host {

struct Parameter {
  std::string_view name;     // "step-length"; an option --step-length, in scripts a word before its values
  std::string_view value;    // what follows, for help: "N", "X Y"; as many words as values
  std::string_view meaning;  // with what it is otherwise
  std::string_view example;  // its values

  std::size_t count() const;  // of values
};

// What a person asks of an action: parameter to its values, as they were typed.
class Wishes {
 public:
  using Values = std::map<std::string, std::vector<std::string>>;

  // `where` names the action for messages: "walk", or "play.script:7: walk".
  Wishes(Values values, std::string where) : values_(std::move(values)), where_(std::move(where)) {}

  bool has(std::string_view name) const { return values_.contains(std::string(name)); }
  std::optional<double> number(std::string_view name, Range range) const;
  double number(std::string_view name, double otherwise, Range range) const;
  std::uint32_t count(std::string_view name, std::uint32_t otherwise, std::uint32_t highest) const;
  std::optional<glm::dvec3> vector(std::string_view name) const;  // of two or three numbers, z then 0
  std::size_t choice(std::string_view name, std::size_t otherwise,
                     std::span<const std::string_view> choices) const;

  const std::string& where() const { return where_; }
  [[noreturn]] void refuse(std::string_view name, const std::string& what, const std::string& remedy) const;

 private:
  double parsed(std::string_view name, const std::string& text, Range range) const;

  Values values_;
  std::string where_;
};

// Who acts, and from which frame on.
struct Scene {
  const Film& film;
  const Actor& actor;
  std::uint32_t at;
  const Wishes& wishes;
  std::string_view action;  // its name

  std::string who() const { return "actor '" + actor.name + "', " + std::string(action); }  // for messages
  const Model& model() const { return film.models[actor.model]; }
  double frames(double seconds) const { return seconds * film.rate; }
  // The frame so many later. Throws where a film has no such frame: to be asked before any work for it is done.
  std::uint32_t last_after(double frames) const;
};

// What comes of it. Keys of what it drives make way: up to the last frame, and all later ones if the figure's
// place is driven.
struct Motion {
  std::vector<ActorKey> keys;
  std::uint32_t last = 0;  // frame, as Scene::last_after() allows
  std::string told;        // more for the person who asked: "the seat is ..."; "" if nothing
};

struct Action {
  std::string_view name;
  std::string_view purpose;
  std::span<const Parameter> parameters;
  Motion (*perform)(const Scene& scene);
};

std::span<const Action> actions();
const Action* find_action(std::string_view name);

struct Performed {
  std::uint32_t first, last;  // frames
  std::string told;
};

// Has an actor of the film do something; the film stays as long as it is. `path` is the film file's, beside which its
// models are. Without `at` the action begins at the actor's last key.
Performed perform(Json& film, const std::filesystem::path& path, const std::string& actor,
                  const Action& action, std::optional<std::uint32_t> at, const Wishes& wishes);

}  // namespace mars::host
