// `mars import`: a model file or a film from a file of another program, with shapes scaled into the unit cube and their
// bounds as sbb.
#pragma once

#include <string>

#include "host/content/importer/import_options.h"

namespace mars::importer {

// Reads the file `from` and writes the model or film `to`. Nodes of scenes with meshes or bones below them become
// joints; a mesh of several colours has a joint for each, fixed to the first. Returns the report of what was read, what
// was made of it, and what was not read.
std::string import_model(const ImportOptions& given);

}  // namespace mars::importer
