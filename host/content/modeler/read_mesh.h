// Meshes in model files (docs/model-format.md): a shape's "mesh".
#pragma once

#include <array>
#include <string_view>

#include "host/content/document/fields.h"
#include "host/content/modeler/mesh.h"

namespace mars::modeler {

inline constexpr std::string_view kMeshNames[] = {"vertices", "faces", "crease", "normals"};
inline constexpr document::Keys kMeshKeys{"mesh", kMeshNames};

// Every number is checked: what is read can be cut into meshlets.
Mesh read_mesh(const document::Element& element);

}  // namespace mars::modeler
