// Steps that pages preview and commit on a film, each kind but for commands.
#include "tests/fuzz/steps.h"
#include "tests/fuzz/target.h"

namespace mars::fuzz {
namespace {

constexpr const char* kSteps = R"(
{"set": "pose", "actor": "pip", "joint": "left-leg", "pose": [10, 0, 0]}
{"set": "poses", "actor": "pip", "poses": {"hip": [1, 2, 3], "head": [0, 0, 9]}}
{"set": "place", "actor": "pip", "place": [1, 2, 3]}
{"set": "turn", "actor": "pip", "turn": [0, 0, 90]}
{"set": "figure", "actor": "pip", "place": [1, 2, 3], "turn": [0, 0, 9], "poses": {"hip": [1, 2, 3]}}
{"set": "camera", "eye": [5, 5, 5], "at": [0, 0, 0], "fov": 30}
{"set": "light", "light": 1, "direction": [1, 0, 1], "color": [1, 0.5, 0], "intensity": 2}
{"set": "light", "light": 2, "place": [1, 2, 3], "at": [0, 0, 0], "cone": [10, 30], "reach": 2}
{"script": {"name": "play.script", "text": "at 0 pip spin degrees 90 until 5\nthen pip go to 1 2 3\nat 8 cut\n"}}
)";

}  // namespace

const Form kForm = Form::bytes;

void take(std::string_view input) {
  static StudioPages pages(small_film(), with_steps(messages_of(kSteps)));
  pages.take(input);
}

}  // namespace mars::fuzz
