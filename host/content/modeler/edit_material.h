// How commands change a material of a model or film file: by values of its keys, as a file writes them.
#pragma once

#include "host/content/document/json_file.h"

namespace mars::modeler {

// Numbers that a new reflection does not use go.
void change_material(document::Json& material, const document::Json& values);

}  // namespace mars::modeler
