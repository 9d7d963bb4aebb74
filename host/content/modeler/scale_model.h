// Proportions as a step that changes a model's JSON: its joints, or if it is derived from another file, its
// proportions.
#pragma once

#include "host/content/document/json_file.h"
#include "host/content/modeler/model.h"
#include "host/content/modeler/proportions.h"

namespace mars::modeler {

// `model` is what the JSON is read as.
void scale_model(document::Json& json, const Model& model, const Proportions& proportions);

}  // namespace mars::modeler
