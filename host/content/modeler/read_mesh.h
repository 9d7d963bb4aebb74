// Meshes in model files (docs/model-format.md): a shape's "mesh".
#pragma once

#include "host/content/document/fields.h"
#include "host/content/modeler/mesh.h"

namespace mars::modeler {

// Every number is checked: what is read can be cut into meshlets.
Mesh read_mesh(const document::Element& element);

}  // namespace mars::modeler
