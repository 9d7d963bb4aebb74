// `mars import`: a model file from a file of another program, with the shape scaled into the unit cube and its bounds
// as sbb.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace mars::importer {

struct ImportOptions {
  std::filesystem::path from, to;
  std::string joint;             // the model's; "": as the file is named
  std::optional<char> up;        // the file's axis that points up: x, y, z; none: as is usual for its kind
  double scale = 1;              // above 0
  std::optional<double> crease;  // degrees, of meshes; none: the file's normals, or what is usual for its kind
  bool force = false;            // `to` may be there already: it is replaced
};

// Reads the patch file or mesh file `from` and writes the model file `to`. A mesh of several colours has a joint for
// each, fixed to the first. The report of what was read, and what was not.
std::string import_model(const ImportOptions& given);

}  // namespace mars::importer
