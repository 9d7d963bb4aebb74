// `mars import` of files without shapes: skeletons and their motions.
#pragma once

#include <glm/mat3x3.hpp>
#include <string>

#include "host/content/importer/file_kind.h"
#include "host/content/importer/import_options.h"
#include "host/content/importer/import_report.h"

namespace mars::importer {

// Of BVH, ASF and AMC, as what `options.as` has. `up` and `upright`: which of the file's axes becomes z, and how.
ImportedText import_motion(const ImportOptions& options, FileKind kind, const std::string& up,
                           const glm::dmat3& upright);

}  // namespace mars::importer
