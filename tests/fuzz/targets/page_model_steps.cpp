// Steps that pages preview and commit on a model, of each kind.
#include "tests/fuzz/steps.h"
#include "tests/fuzz/target.h"

namespace mars::fuzz {
namespace {

constexpr const char* kSteps = R"(
{"set": "pose", "joint": "left-leg", "pose": [10, 0, 0]}
{"set": "poses", "poses": {"hip": [1, 2, 3], "head": [0, 0, 9]}}
{"set": "joint", "joint": "left-leg", "change": {"place": [0, 0.5, -0.1], "x_axis": [1, 0, 0], "y_axis": [0, 1, 0], "freedom": "free", "limits": {"x": [-20, 20]}, "shape": "cone", "options": {"top": 0.5}, "sbb": [[-1, -1, -1], [1, 1, 1]], "limb": "left.knee", "material": "shirt"}}
{"set": "joint", "joint": "head", "change": {"name": "skull", "parent": "left-leg", "freedom": "fixed"}}
{"set": "joint", "joint": "left-leg", "change": {"reset": ["limits"]}}
{"add": "joint", "joint": "tail", "change": {"parent": "hip", "shape": "torus", "options": {"tube": 0.2}, "freedom": "fixed"}}
{"set": "point", "joint": "hip", "patch": 2, "point": [0, 3], "to": [0.5, 0.5, 0.5]}
{"mirror": "left"}
{"mirror": "left", "joint": "left-leg"}
{"set": "material", "material": "shirt", "change": {"color": [0, 0, 1], "name": "coat", "reflection": "blinn-phong", "exponent": 9, "sides": 2, "interpolation": "phong"}}
{"add": "material", "material": "gold", "change": {"color": [1, 1, 0], "reflection": "metallic-roughness", "roughness": 0.3, "metallic": 1}}
{"remove": "material", "material": "gold"}
{"remove": "joint", "joint": "tail", "branch": true}
{"scale": {"branches": {"hip": 2}, "joints": {"hip": [1, 1, 2]}, "height": 3, "ground": true}}
{"body": "dog", "height": 1}
)";
constexpr const char* kOthers = R"(
{"set": "point", "joint": "head", "point": [1, 1], "to": [0.5, 0.5, 0.5]}
)";

}  // namespace

const Form kForm = Form::bytes;

void take(std::string_view input) {
  static StudioPages pages(small_model(), with_steps(messages_of(kSteps)), with_steps(messages_of(kOthers)));
  pages.take(input);
}

}  // namespace mars::fuzz
