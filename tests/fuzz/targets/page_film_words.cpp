// Steps of commands: the words of each `mars film`, edited.
#include "tests/fuzz/steps.h"
#include "tests/fuzz/target.h"

namespace mars::fuzz::page_film_words {
namespace {

constexpr const char* kSteps = R"(
{"commands": [["film", "set", "frames=20", "size=64,32", "rate=24", "samples=4", "background=0.6,0.7,0.8", "color=linear", "curve=filmic", "dice=8", "intervals=auto"]]}
{"commands": [["film", "add", "table", "--model", "table", "--place", "2", "0", "0", "--turn", "30", "--height", "2"], ["film", "show"]]}
{"commands": [["film", "add", "other", "--model", "pip", "--turn", "1", "2", "3"], ["film", "remove", "other"]]}
{"commands": [["film", "rename", "pip", "bob"], ["film", "rename", "bob", "pip"]]}
{"commands": [["film", "light", "add", "place=1,2,3", "at=0,0,0", "cone=20,30", "color=1,1,0", "intensity=2", "reach=9"], ["film", "light", "remove", "3"]]}
{"commands": [["film", "camera", "near=0.5", "far=500", "fov=35", "up=0,1,0", "projection=orthographic", "height=4", "shift=0.2,-0.1"]]}
{"commands": [["film", "light", "add", "direction=1,2,3"], ["film", "light", "remove", "1"]]}
{"commands": [["film", "material", "add", "gold", "color=1,0.8,0", "reflection=metallic-roughness", "roughness=0.3", "metallic=1", "--actor", "pip"], ["film", "material", "set", "gold", "ambient=0.2", "sides=2", "interpolation=phong", "casts=false", "receives=true"], ["film", "material", "remove", "gold"]]}
)";
constexpr const char* kOthers = R"(
{"commands": [["film", "new", "frames=3", "--figure", "man"]]}
{"commands": [["film", "light", "rig"]]}
{"commands": [["film", "remove", "pip"]]}
{"commands": [["film", "add", "other", "--model", "../other.json"]]}
{"commands": [["animate", "film", "x"]]}
)";

}  // namespace

void take(std::string_view input) {
  static StudioPages pages(small_film(), with_steps(messages_of(kSteps)), with_steps(messages_of(kOthers)));
  pages.take(input);
}

const Target target("page_film_words", Form::bytes, take);

}  // namespace mars::fuzz::page_film_words
