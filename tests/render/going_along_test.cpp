// A film in which actors are carried and the camera goes along has the same pixels however it is divided, and keeps
// what stands still.
#include <gtest/gtest.h>

#include "host/content/animator/reading/read_film.h"
#include "host/content/film/compile.h"
#include "tests/render/film_run.h"

namespace mars::test {
namespace {

constexpr const char* kFilm = R"({"frames": 8, "size": [96, 54], "samples": 2,
"camera": {"eye": {"actor": "tom", "offset": [0, -6, 1.5], "level": true}, "at": {"actor": "tom", "joint": "b"}},
"models": {"arm": {"joints": [{"name": "a", "segment": {"shape": "box"}},
  {"name": "b", "parent": "a", "place": [1, 0, 1], "segment": {"shape": "sphere"}}]}},
"actors": [
  {"name": "ball", "model": "arm", "place": [-2, 1, 0],
   "keys": [{"frame": 2, "attach": {"actor": "tom", "joint": "b", "place": [0, 0, 1]}}, {"frame": 6, "attach": null}]},
  {"name": "tom", "model": "arm", "keys": [{"frame": 0, "place": [0, 0, 0], "pose": {"a": [0, 0, 0], "b": [0, 0, 0]}},
    {"frame": 4, "place": [1, 0, 0], "pose": {"a": [0, 0, 30], "b": [0, 60, 0]}}]},
  {"name": "floor", "model": "arm", "place": [0, 3, -2]}]})";

TEST(GoingAlong, SamePixelsOnAnyNumberOfNodes) {
  const document::Document document(kFilm, "f.json");
  const film::CompiledFilm film = film::compile(animator::read_film(document.root(), "/nowhere"));
  RunOptions from_scratch;
  from_scratch.work.coherence = false;
  const FilmRun expected = run_film(film.block(), from_scratch);
  for (const int nodes : {1, 2, 3}) {
    RunOptions options;
    options.nodes = nodes;
    expect_same(run_film(film.block(), options), expected, film.view().settings(),
                "going-along-" + std::to_string(nodes) + "-nodes");
  }
}

}  // namespace
}  // namespace mars::test
