// Steps that pages preview and commit on a model, of each kind.
#include "tests/fuzz/steps.h"
#include "tests/fuzz/target.h"

namespace mars::fuzz::page_model_steps {
namespace {

constexpr const char* kSteps = R"(
{"pose": {"left-leg": [10, 0, 0]}}
{"pose": {"hip": [1, 2, 3], "head": [0, 0, 9]}}
{"commands": [["model", "set", "left-leg", "--place", "0", "0.5", "-0.1", "--x-axis", "1", "0", "0", "--y-axis", "0", "1", "0", "--free", "--limits", "x", "-20", "20", "--shape", "cone", "--with", "top=0.5", "--sbb", "-1", "-1", "-1", "1", "1", "1", "--limb", "left.knee", "--material", "shirt"]]}
{"commands": [["model", "set", "head", "--name", "skull", "--parent", "left-leg", "--fixed"]]}
{"commands": [["model", "set", "left-leg", "--reset", "limits"], ["model", "check"]]}
{"commands": [["model", "add", "tail", "--parent", "hip", "--shape", "torus", "--with", "tube=0.2", "--fixed"], ["model", "remove", "tail", "--branch"]]}
{"commands": [["model", "point", "hip", "--patch", "2", "--at", "0", "3", "--to", "0.5", "0.5", "0.5"]]}
{"commands": [["model", "mirror", "left"], ["model", "mirror", "left", "left-leg"]]}
{"commands": [["model", "set", "--material", "shirt", "--color", "0", "0", "1", "--name", "coat", "--reflection", "blinn-phong", "--exponent", "9", "--sides", "2", "--interpolation", "phong", "--casts", "false", "--receives", "true"]]}
{"commands": [["model", "add", "--material", "gold", "--color", "1", "1", "0", "--reflection", "metallic-roughness", "--roughness", "0.3", "--metallic", "1"], ["model", "remove", "--material", "gold"]]}
{"commands": [["model", "scale", "2", "--branch", "hip", "--height", "3"], ["model", "scale", "1", "1", "2", "--joint", "hip", "--no-ground"], ["model", "show"]]}
{"commands": [["model", "new", "--figure", "box", "--height", "1", "--replace"]]}
)";
constexpr const char* kOthers = R"(
{"commands": [["model", "point", "head", "--at", "1", "1", "--to", "0.5", "0.5", "0.5"]]}
{"commands": [["model", "new", "--from", "../other.json", "--replace"]]}
)";

}  // namespace

void take(std::string_view input) {
  static StudioPages pages(small_model(), with_steps(messages_of(kSteps)), with_steps(messages_of(kOthers)));
  pages.take(input);
}

const Target target("page_model_steps", Form::bytes, take);

}  // namespace mars::fuzz::page_model_steps
