// Film files: read, looked over as `mars animate check` and `keys` do, compiled where small, and laid out again.
#include "host/content/animator/pose/check.h"
#include "host/content/animator/reading/film_version.h"
#include "host/content/animator/listing/keys_table.h"
#include "host/content/animator/reading/read_film.h"
#include "host/content/document/json_file.h"
#include "host/content/film/compile.h"
#include "host/content/film/describe.h"
#include "tests/fuzz/scratch.h"
#include "tests/fuzz/target.h"

namespace mars::fuzz::film_json {
namespace {

// What is made of longer films takes long, and is nothing else.
constexpr std::uint32_t kMostFrames = 60;
constexpr std::size_t kMostActors = 20;

constexpr const char* kModel = R"({"joints": [
  {"name": "hip", "place": [0, 0, 1], "limits": {"x": [-30, 90]}, "segment": {"shape": "box", "material": "red"}},
  {"name": "knee", "parent": "hip", "place": [0, 0, -0.5], "limits": {"x": [-90, 0], "z": [-5, 5]}}],
  "materials": {"red": {"color": [1, 0, 0]}}})";

}  // namespace

void take(std::string_view input) {
  static const auto model = scratch().file("model.json", kModel);
  const auto path = scratch().file("film.json", input);
  const animator::Film film = animator::read_film(path);
  if (film.frames > kMostFrames || film.actors.size() > kMostActors) return;
  animator::check_film(film);
  animator::warnings_of(film);
  document::Json json = document::read_json(path);
  animator::keys_table(json, film, {true, "", {}}, {0, film.frames});
  animator::make_keys(json, film, {true, "", {}}, film.frames / 2, {}, animator::Beyond::clamped);
  animator::write_version(json);
  document::laid_out(json);
  film::CompileOptions small;
  small.size = {32, 16};
  film::compile(film, small);
}

const Target target("film_json", Form::text, take);

}  // namespace mars::fuzz::film_json
