// The words of `mars animate FILM ...`, `mars film FILM ...` and `mars model MODEL ...`, as commands of a program.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "host/cli/command.h"
#include "host/editing/edited_film.h"
#include "host/editing/edited_model.h"

namespace mars::editing {

// `mars animate`, without its FILM. `film` must outlive the parser; `code` becomes the exit code where it is not 0.
cli::Command add_animate(cli::Command mars, EditedFilm& film, int& code);

// `mars animate pose` alone, for who says it at every move of a hand.
void add_animate_pose(cli::Command mars, EditedFilm& film);

// Adds `mars film` in the same way.
cli::Command add_film(cli::Command mars, EditedFilm& film);

// `mars model`, without its MODEL.
cli::Command add_model(cli::Command mars, EditedModel& model);
std::vector<std::string_view> model_verbs();

// `reduce`.
void add_reduce(cli::Command animate, EditedFilm& film);
// `tangent`.
void add_tangent(cli::Command animate, EditedFilm& film);
// attach, detach, look and follow.
void add_carrying(cli::Command animate, EditedFilm& film);

// `motion`.
void add_transfer(cli::Command animate, EditedFilm& film);

// A command for each action of motion::actions(), and script.
void add_motion(cli::Command animate, EditedFilm& film);

}  // namespace mars::editing
