// What a person asks of `mars import`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/content/importer/model_size.h"

namespace mars::importer {

enum class ImportAs { model, film };
enum class ImportMotion { keys, matrices };

struct ImportOptions {
  std::filesystem::path from, to;
  std::vector<std::filesystem::path> more;  // motions of `from`'s skeleton, which follow it; of AMC
  std::filesystem::path skeleton;           // of AMC; "": the one beside it
  std::optional<ImportAs> as;               // none: a film of BVH and AMC, else a model
  std::optional<double> rate, file_rate;    // frames a second of the film; of a file that does not say them
  std::string animation;                    // of a film of glTF; "": the first
  std::optional<ImportMotion> motion;       // of glTF's joints; none: keys if they show all of it
  std::string joint;      // the model's first one, and a film's model and actor; "": as the file is named
  std::string up, front;  // as in orientation.h; "" for `up`: as is usual for the file's kind
  ModelSize size;
  std::optional<double> crease;  // degrees, of meshes; none: the file's normals, or what is usual for its kind
  bool force = false;            // `to` may be there already: it is replaced
};

}  // namespace mars::importer
