// Steps that change a model, on its JSON: those that `mars model` has, and those by hand.
#pragma once

#include "host/content/animator/within_limits.h"
#include "host/studio/project/step.h"

namespace mars::studio {

// `meaning`: what `json` is read as. Returns remarks. Throws Failure, also of a step that changes no model.
animator::Remarks change_model(Json& json, const modeler::Model& meaning, const Step& step);

}  // namespace mars::studio
