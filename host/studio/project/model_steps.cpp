#include "host/studio/project/model_steps.h"

#include "hal/failure/failure.h"
#include "host/content/document/text.h"
#include "host/content/modeler/figure_library.h"
#include "host/content/modeler/mirror.h"
#include "host/content/modeler/proportions.h"

namespace mars::studio {
namespace {

using animator::Remarks;

[[noreturn]] void refuse(const char* what) {
  throw Failure(std::string("a model has no ") + what, "", "set it in a film: mars studio FILM");
}

class ModelSteps {
 public:
  ModelSteps(Json& json, const modeler::Model& meaning) : json_(json), meaning_(meaning) {}

  Remarks operator()(const FigureStep&) { refuse("place or turn of its own"); }
  Remarks operator()(const CameraStep&) { refuse("camera"); }
  Remarks operator()(const LightStep&) { refuse("lights"); }

  Remarks operator()(const CommandsStep&) { refuse("keys, which commands could change"); }
  Remarks operator()(const ScriptStep&) { refuse("actors, whom a script could move"); }

  Remarks operator()(const JointStep& step) {
    switch (step.verb) {
      case Verb::set: modeler::set_joint(json_, step.joint, step.change); break;
      case Verb::add: modeler::add_joint(json_, step.joint, step.change); break;
      case Verb::remove: modeler::remove_joint(json_, step.joint, step.branch); break;
    }
    return {};
  }

  Remarks operator()(const MaterialStep& step) {
    switch (step.verb) {
      case Verb::set: modeler::set_material(json_, step.material, step.change, step.name); break;
      case Verb::add: modeler::add_material(json_, step.material, step.change); break;
      case Verb::remove: modeler::remove_material(json_, step.material); break;
    }
    return {};
  }

  Remarks operator()(const PointStep& step) {
    const std::string made = modeler::set_point(json_, meaning_, step.joint, step.point);
    if (made.empty()) return {};
    return {"the shape of '" + step.joint + "' is the model's own now: '" + made + "'"};
  }

  Remarks operator()(const MirrorStep& step) {
    const modeler::Mirrored done = modeler::mirror(json_, meaning_, step.from, step.joint);
    Remarks remarks;
    if (!done.changed.empty()) remarks.push_back("changed as in a mirror: " + document::joined(done.changed));
    if (!done.added.empty()) remarks.push_back("added as in a mirror: " + document::joined(done.added));
    return remarks;
  }

  Remarks operator()(const ScaleStep& step) {
    modeler::scale_model(json_, meaning_, step.proportions);
    return {};
  }

  Remarks operator()(const BodyStep& step) {
    json_ = modeler::library_figure(step.body, step.height);
    return {};
  }

 private:
  Json& json_;
  const modeler::Model& meaning_;
};

}  // namespace

Remarks change_model(Json& json, const modeler::Model& meaning, const Step& step) {
  return std::visit(ModelSteps(json, meaning), step);
}

}  // namespace mars::studio
