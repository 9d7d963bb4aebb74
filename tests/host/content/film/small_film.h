// Small films as text, read and compiled, for tests.
#pragma once

#include <string>

#include "host/content/animator/reading/read_film.h"
#include "host/content/film/compile.h"

namespace mars::film {

inline animator::Film film_of(const std::string& json) {
  const document::Document document(json, "f.json");
  return animator::read_film(document.root(), "/nowhere");
}

inline CompiledFilm compiled(const std::string& json, const CompileOptions& options = {}) {
  return compile(film_of(json), options);
}

// A film of an arm of two joints, `a` free and `b` a hinge about y, with more keys, and these actors.
inline std::string arm_film(const std::string& actors, const std::string& more = "\"frames\": 20") {
  return "{" + more + R"(,
"camera": {"eye": [0, -9, 2]},
"materials": {"red": {"color": [1, 0, 0]}, "glow": {"keys": [{"frame": 3, "ambient": 0}, {"frame": 6, "ambient": 1}]}},
"models": {"arm": {"joints": [
  {"name": "a", "segment": {"shape": "box"}},
  {"name": "b", "parent": "a", "place": [1, 0, 0], "limits": {"y": [-10, 400]},
   "segment": {"shape": "sphere", "sbb": [[-1, -1, -1], [1, 1, 1]], "material": "red"}}]}},
"actors": [)" +
         actors + "]}";
}

// The same of a sleeve that follows two joints, of which the second is a hinge about y.
inline std::string sleeve_film(const std::string& actors, const std::string& more = "\"frames\": 20") {
  return "{" + more + R"(,
"camera": {"eye": [0, -9, 2]},
"models": {"arm": {
  "shapes": {"cloth": {"mesh": {
    "vertices": [[0, 0, 0], [0, 1, 0], [0, 0.5, 1], [1, 0, 0], [1, 1, 0], [1, 0.5, 1]],
    "faces": [[0, 1, 2], [5, 4, 3], [1, 0, 3, 4], [2, 1, 4, 5], [0, 2, 5, 3]],
    "bones": [[0, 2], [0, 1], [1, 1, 0, 3], [1, 1], [0, 0, 1, 0.5], [1, 1]]}}},
  "joints": [
    {"name": "sleeve", "place": [0, 0, 1], "segment": {"shape": "cloth", "sbb": [[0, -0.5, -0.5], [4, 0.5, 0.5]],
     "skin": {"joints": ["upper", "fore"]}}},
    {"name": "upper", "parent": "sleeve"},
    {"name": "fore", "parent": "upper", "place": [2, 0, 0], "limits": {"y": [-150, 0]}}]}},
"actors": [)" +
         actors + "]}";
}

}  // namespace mars::film
