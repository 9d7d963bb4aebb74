// `mars import --as film` of glTF, GLB, FBX and COLLADA: a film of all that the file's scene shows.
#pragma once

#include "host/content/importer/file_kind.h"
#include "host/content/importer/import_mesh.h"
#include "host/content/importer/import_options.h"
#include "host/content/importer/import_report.h"

namespace mars::importer {

// The model, one animation as what an actor does, the camera and the lights. Refuses what import_mesh() refuses, and
// animations that cannot be read.
ImportedText import_gltf_film(const ImportOptions& options, FileKind kind, const Stance& stance);

}  // namespace mars::importer
