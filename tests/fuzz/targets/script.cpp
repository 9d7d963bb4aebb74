// Motion scripts, played on a film with a figure and a ball.
#include "host/content/animator/motion/script/script.h"
#include "host/content/document/json_file.h"
#include "tests/fuzz/scratch.h"
#include "tests/fuzz/target.h"

namespace mars::fuzz::script {
namespace {

const std::filesystem::path& film_path() {
  static const std::filesystem::path path = MARS_FUZZ_FILM;
  return path;
}

}  // namespace

void take(std::string_view input) {
  static const document::Json sound = document::read_json(film_path());
  document::Json film = sound;
  motion::play_script(film, film_path(), std::string(input), "play.script");
}

const Target target("script", Form::text, take);

}  // namespace mars::fuzz::script
