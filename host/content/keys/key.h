// The keys of film and model files: of each object that a file describes the keys that it may have, and of each key
// what it is. One table, from which come readers' checks and messages, the words of commands and their help, the JSON
// Schemas and tables in docs/, and the studio's fields.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace mars::keys {

inline constexpr double kFarthest = 1e9;  // of any coordinate or length, from the origin

struct Range {
  double lowest = -kFarthest;
  double highest = kFarthest;

  bool operator==(const Range&) const = default;
};

inline constexpr Range kDegrees{-1e6, 1e6};  // of turns and their limits

// What an object can be: a light a spot, a film one of linear colours.
struct Kind {
  std::string_view name;                               // "spot"
  std::string_view label;                              // in the studio: "Spot"
  std::span<const std::string_view> begins_with = {};  // the words, KEY=VALUE, with which the studio makes one
};

inline constexpr unsigned kEveryKind = ~0u;

// Of a number that some of its object's kinds measure otherwise.
struct Measure {
  Range range;
  std::string_view unit = {};
};

// One of `type`: "number", "whole" (a number), "choice" (of `choices`), "text", "file" (its name, as seen from the
// folder of the file that names it), "flag" (true or false); a type of types(), such as "color"; an object of
// objects(), such as "light"; "[light]": a list of them; "{material}": an object of them by their names.
struct Key {
  std::string_view name;
  std::string_view type = "number";
  std::string_view meaning;           // a sentence's beginning, without its range, unit and default
  std::string_view see = {};          // a heading of docs/ that says more: "#fog"
  std::optional<double> number = {};  // the default of a number
  std::string_view json = {};         // the default of another type, as a file writes it
  std::string_view without = {};      // what holds where it is left out, in words, if no value can say it
  Range range = {};                   // of a number; of a list's length
  std::span<const std::string_view> choices = {};
  std::string_view unit = {};        // "degrees"
  bool keyed = false;                // keys of the film may change it
  std::string_view keyed_type = {};  // its type there, if it is not the same or a part
  bool required = false;
  bool typed = true;                       // `mars film` takes it as KEY=VALUE, `mars model` as --key
  std::string_view example = {};           // how it is written, for messages; none: as the default
  unsigned of = kEveryKind;                // bits of those of its object's kinds that have it
  std::span<const Measure> measures = {};  // of each kind, in place of range and unit; none: these are of every kind
  std::string_view label = {};             // of the studio's field; none: its name
  bool rare = false;                       // the studio's field is in a part that is shut at first

  constexpr bool is_of(unsigned kind) const { return (of >> kind & 1u) != 0; }
  constexpr const Range& range_of(unsigned kind) const { return measures.empty() ? range : measures[kind].range; }
};

// What values of several keys look like.
struct Type {
  std::string_view name;
  std::string_view schema;      // JSON Schema, in which "#name" stands for the type or object of that name
  std::string_view example;     // as Key's
  std::string_view words = {};  // what options take in place of a list's numbers: "X Y Z"
  std::span<const std::string_view> parts = {};  // of a list of numbers, what each is: "width", "height"
};

struct Object {
  std::string_view name;  // "light"; "light_key" what keys of a light may have
  std::string_view meaning;
  std::vector<Key> keys;
  std::string_view rules = {};       // more of its JSON Schema
  std::string_view example = {};     // as Key's, where it stands under a name of its own
  std::span<const Kind> kinds = {};  // none: all are of one kind

  std::vector<std::string_view> names = {};  // of its keys

  std::vector<std::string_view> typed_names() const;  // of keys that commands take
  const Key* find(std::string_view key) const;        // null where there is none
  const Key& key(std::string_view name) const;        // checked
};

// The objects of a file: first the file itself.
std::span<const Object> film_objects();
std::span<const Object> model_objects();
std::span<const Type> film_types();
std::span<const Type> model_types();

// Of files, or "shape": the options of shapes, which stand in segments. Null where there is none.
const Object* find_object(std::string_view name);
const Object& object(std::string_view name);  // checked
const Range& range_of(std::string_view object, std::string_view key);
const Type* find_type(std::string_view name);

}  // namespace mars::keys
