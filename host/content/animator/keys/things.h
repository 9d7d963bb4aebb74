// What in a film has keys - camera, lights, materials, actors - with the parts of each and what they are at any
// frame, joined to where it stands in the film file. And how a person chooses among them.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "host/content/animator/pose/film.h"
#include "host/content/document/json_file.h"

namespace mars::animator {

// A part of a thing that can change: "place", "eye"; a joint's pose is "/" and its name.
struct KeyedPart {
  std::string name;
  const modeler::Joint* joint;  // whose limits bound it; null: no joint
  const modeler::Joint* turns;  // by the smallest turn from key to key; null: straight on
  std::function<document::Json(std::uint32_t frame)> value_at;  // as a film file writes it; read_film's own on a key
  // Where a key may hold more than numbers - a point of an actor, what carries an actor -, that; `value_at` is then the
  // place in the world, or null.
  std::function<document::Json(std::uint32_t frame)> held_at{};
  bool unset = false;  // the thing can have it and does not: its value is then 0, of as many numbers as it would have

  // What a key there holds, so that all stays as it is.
  document::Json key_at(std::uint32_t frame) const { return held_at ? held_at(frame) : value_at(frame); }
};

struct Thing {
  std::string name;  // for messages: "actor 'robot'", "camera", "light/2", "material/skin"
  document::Json* json;
  bool actor;
  std::vector<KeyedPart> parts;       // of an actor: place, turn and all joints
  std::vector<KeyedPart> unset = {};  // such as the reach of a light that does not fall off

  const KeyedPart& part(const std::string& wanted) const;  // one of `parts` or `unset`
  bool can_get(const std::string& wanted) const;           // whether it is one of `unset`
};

// Those of the keys of the table that may be keyed, in its order, with those that are unset. The film must outlive
// them.
std::vector<KeyedPart> camera_parts(const Film& film);
std::vector<KeyedPart> light_parts(const LightMotion& light);

// Either everything in the film, or an actor, "camera", "light/2" (from 1) or "material/skin", and of it these parts:
// all if none are named. A joint is named as in its model, or with a slash before it where it is called place or turn;
// "*-shin" names all parts like it that can change, "/*" all such joints.
struct Choice {
  bool all = false;
  std::string thing;
  std::vector<std::string> parts;
};

struct Chosen {
  Thing thing;
  std::vector<std::string> parts;  // names of its parts
};

// `film` is what `meaning` was read from; both must outlive what is chosen. Throws where a name is unknown or an
// actor is moved by matrices; those are left out where all is chosen.
std::vector<Chosen> choose(document::Json& film, const Film& meaning, const Choice& choice);

// The parts' own names of what a person calls them: "elbow" is "/elbow"; of a pattern, all like it that can change.
// Throws where there is none.
std::vector<std::string> parts_named(const Thing& thing, const std::string& name);

// Whether it stands for parts like it: it is none's name, and has *, ? or [.
bool is_pattern(const Thing& thing, const std::string& name);

}  // namespace mars::animator
