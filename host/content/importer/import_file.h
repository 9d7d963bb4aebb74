// `mars import`: a model file or a film from a file of another program, with shapes scaled into the unit cube and their
// bounds as sbb.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/content/importer/model_size.h"

namespace mars::importer {

enum class ImportAs { model, film };

struct ImportOptions {
  std::filesystem::path from, to;
  std::vector<std::filesystem::path> more;  // motions of `from`'s skeleton, which follow it; of AMC
  std::filesystem::path skeleton;           // of AMC; "": the one beside it
  std::optional<ImportAs> as;               // none: a film of BVH and AMC, else a model
  std::optional<double> rate, file_rate;    // frames a second of the film; of a file that does not say them
  std::string joint;      // the model's first one, and a film's model and actor; "": as the file is named
  std::string up, front;  // as in orientation.h; "" for `up`: as is usual for the file's kind
  ModelSize size;
  std::optional<double> crease;  // degrees, of meshes; none: the file's normals, or what is usual for its kind
  bool force = false;            // `to` may be there already: it is replaced
};

// Reads the file `from` and writes the model or film `to`. Nodes of glTF with meshes below them become
// joints; a mesh of several colours has a joint for each, fixed to the first. The report of what was read, what was
// made of it, and what was not read.
std::string import_model(const ImportOptions& given);

}  // namespace mars::importer
