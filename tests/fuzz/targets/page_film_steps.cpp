// What hands do to a film, as steps that pages preview and commit; and scripts.
#include "tests/fuzz/steps.h"
#include "tests/fuzz/target.h"

namespace mars::fuzz::page_film_steps {
namespace {

constexpr const char* kSteps = R"(
{"commands": [["animate", "pose", "pip", "left-leg=10,0,0", "--frame", "3", "--clamp"]]}
{"commands": [["animate", "pose", "pip", "left-leg=10,0,0", "--falloff", "3", "--frame", "3", "--clamp"]]}
{"commands": [["animate", "pose", "pip", "hip=1,2,3", "head=0,0,9", "place=1,2,3", "turn=0,0,90", "--frame", "0", "--clamp"]]}
{"commands": [["animate", "pose", "camera", "eye=5,5,5", "at=0,0,0", "fov=30", "--frame", "4", "--clamp"]]}
{"commands": [["animate", "pose", "light/1", "direction=1,0,1", "color=1,0.5,0", "intensity=2", "--frame", "0"]]}
{"commands": [["animate", "pose", "light/2", "place=1,2,3", "at=0,0,0", "cone=10,30", "reach=2", "--frame", "0"]]}
{"script": {"name": "play.script", "text": "at 0 pip spin degrees 90 until 5\nthen pip go to 1 2 3\nat 8 cut\n"}}
)";

}  // namespace

void take(std::string_view input) {
  static StudioPages pages(small_film(), with_steps(messages_of(kSteps)));
  pages.take(input);
}

const Target target("page_film_steps", Form::bytes, take);

}  // namespace mars::fuzz::page_film_steps
