// How an actor stands at a frame, asked alone, is what the compiled film has.
#include "host/content/animator/pose/actor_state.h"

#include <gtest/gtest.h>

#include "tests/host/content/film/small_film.h"

namespace mars::film {
namespace {

TEST(ActorState, ItsMatricesAreTheCompiledFilms) {
  const animator::Film film = film_of(arm_film(
      R"({"name": "x", "model": "arm", "keys": [
           {"frame": 2, "place": [1, 2, 3], "turn": [10, 20, 30], "pose": {"a": [10, 20, 30], "b": [0, 10, 0]}, "ease": "both"},
           {"frame": 15, "place": [4, 2, 3], "turn": [0, 20, 80], "pose": {"a": [-40, 70, 3], "b": [0, 300, 0]}}]},
         {"name": "y", "model": "arm", "matrices": [
           {"frame": 0, "segments": {"a": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]], "b": [[1, 0, 0, 5], [0, 1, 0, 0], [0, 0, 1, 0]]}},
           {"frame": 7, "segments": {"a": [[2, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]}}]})"));
  const CompiledFilm compiled = compile(film);
  const wire::PackedFilm view = compiled.view();
  for (std::uint32_t frame = 0; frame < film.frames; ++frame)
    for (std::size_t segment = 0; segment < 4; ++segment) {
      const animator::ActorState state = animator::state_at(film, segment / 2, frame);
      EXPECT_EQ(*state.segments[segment % 2], view.matrix_at(view.segments()[segment], frame)) << frame;
    }
  EXPECT_EQ(animator::state_at(film, 0, 15).pose[1], glm::dvec3(0, 300, 0));
  EXPECT_EQ(animator::state_at(film, 0, 0).place, glm::dvec3(1, 2, 3));
  EXPECT_EQ(animator::state_at(film, 0, 19).turn, glm::dvec3(0, 20, 80));
}

}  // namespace
}  // namespace mars::film
