// `mars import`: a model file from a file of another program, with the shape scaled into the unit cube and its bounds
// as sbb.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "host/content/importer/model_size.h"

namespace mars::importer {

struct ImportOptions {
  std::filesystem::path from, to;
  std::string joint;      // the model's; "": as the file is named
  std::string up, front;  // as in orientation.h; "" for `up`: as is usual for the file's kind
  ModelSize size;
  std::optional<double> crease;  // degrees, of meshes; none: the file's normals, or what is usual for its kind
  bool force = false;            // `to` may be there already: it is replaced
};

// Reads the patch file or mesh file `from` and writes the model file `to`. Nodes of glTF with meshes below them become
// joints; a mesh of several colours has a joint for each, fixed to the first. The report of what was read, what was
// made of it, and what was not read.
std::string import_model(const ImportOptions& given);

}  // namespace mars::importer
