// The model of a skeleton: each bone is a slender spindle from its joint to the next, so that the motion can be seen.
#pragma once

#include "host/content/document/json_file.h"
#include "host/content/importer/motions/skeleton.h"

namespace mars::importer {

// As a model file. Names must be a model's, each once. Refuses, in a failure that names `file`, a skeleton whose
// bones have no length.
document::Json skeleton_model(const Skeleton& skeleton, const std::string& file);

}  // namespace mars::importer
