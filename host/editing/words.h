// The words of `mars animate FILM ...` and `mars film FILM ...`, as commands of a parser.
#pragma once

#include <cstdint>
#include <string>

#include "host/editing/edited_film.h"

namespace CLI {
class App;
}

namespace mars::editing {

// `mars animate`, without its FILM. `film` must outlive the parser; `code` becomes the exit code where it is not 0.
CLI::App& add_animate(CLI::App& mars, EditedFilm& film, int& code);

// `mars film`, likewise.
CLI::App& add_film(CLI::App& mars, EditedFilm& film);

// `reduce`.
void add_reduce(CLI::App& animate, EditedFilm& film);
// `tangent`.
void add_tangent(CLI::App& animate, EditedFilm& film);
// attach, detach, look and follow.
void add_carrying(CLI::App& animate, EditedFilm& film);

// A command for each action of motion::actions(), and script.
void add_motion(CLI::App& animate, EditedFilm& film);

}  // namespace mars::editing
