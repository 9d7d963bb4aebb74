// `mars import` of meshes and scenes (OBJ, STL, PLY, glTF, GLB, FBX, COLLADA), which become a model.
#pragma once

#include <glm/mat3x3.hpp>
#include <string>
#include <vector>

#include "host/content/importer/file_kind.h"
#include "host/content/importer/import_options.h"
#include "host/content/importer/import_report.h"
#include "host/content/importer/imported_mesh.h"

namespace mars::importer {

// How a person wants the model to stand.
struct Stance {
  std::string up;  // the file's axis, never ""
  glm::dmat3 upright;
};

// "1.2 x 0.33 x 1.45 units, 1.45 m tall, the file's y upward": only scenes say what their unit is.
std::string box_text(const glm::dvec3& extent, double factor, FileKind kind, const Stance& stance);

// Reads options.from; `rest` as in MeshOptions. Refuses to replace a file that is read with it.
MeshFile read_mesh(const ImportOptions& options, FileKind kind, const Stance& stance,
                   std::vector<glm::dmat4> rest = {});

// As a model file. Leaves the file without its meshes.
document::LongText model_text_of(MeshFile& file);

// A report but for what the model or film is.
ImportReport report_of(const MeshFile& file, FileKind kind, const Stance& stance);

ImportedText import_mesh(const ImportOptions& options, FileKind kind, const Stance& stance);

}  // namespace mars::importer
