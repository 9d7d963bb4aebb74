// Model files, with meshes, B-spline surfaces and limbs; what `mars model MODEL show` and `check` say of them.
#include "host/content/document/json_file.h"
#include "host/content/modeler/describe.h"
#include "host/content/modeler/edit.h"
#include "host/content/modeler/model_file.h"
#include "host/content/modeler/review.h"
#include "tests/fuzz/scratch.h"
#include "tests/fuzz/target.h"

namespace mars::fuzz::model_json {

namespace {

// From which inputs may make models of other proportions.
constexpr const char* kBase = R"({"joints": [
  {"name": "hip", "place": [0, 0, 1], "segment": {"shape": "box", "material": "shirt"}},
  {"name": "head", "parent": "hip", "place": [0, 0, 1], "segment": {"shape": "sphere"}},
  {"name": "knee", "parent": "hip", "place": [0, 0, -0.5]}],
  "materials": {"shirt": {"color": [1, 0, 0]}}})";

}  // namespace

void take(std::string_view input) {
  static const auto base = scratch().file("base.json", kBase);
  const auto path = scratch().file("model.json", input);
  const modeler::Model model = modeler::load_own_model(path);
  modeler::doubts_about(model);
  document::Json json = document::read_json(path);
  modeler::JointChange change;
  change.joint["place"] = {1, 2, 3};
  change.freedom = modeler::Freedom::free;
  modeler::set_joint(json, model.joints.front().name, change);
  if (model.joints.size() > 1) modeler::remove_joint(json, model.joints.back().name, true);
  document::laid_out(json);
}

const Target target("model_json", Form::text, take);

}  // namespace mars::fuzz::model_json
