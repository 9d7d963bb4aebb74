// What a mesh has for the day when surfaces show it: places in images and colours of vertices. Files keep them; they
// change no picture.
#pragma once

#include "host/content/document/fields.h"
#include "host/content/modeler/mesh.h"

namespace mars::modeler {

// Refuses keys uv, colors and paint_faces of the mesh file `fields` that do not fit each other or `mesh`, whose faces
// these are.
void check_paint(const document::Fields& fields, const Mesh& mesh);

}  // namespace mars::modeler
