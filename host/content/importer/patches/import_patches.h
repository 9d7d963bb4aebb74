// `mars import` of Bezier patches: .bpt, POV-Ray and RIB become a model with patches.
#pragma once

#include "host/content/importer/file_kind.h"
#include "host/content/importer/import_mesh.h"
#include "host/content/importer/import_options.h"
#include "host/content/importer/import_report.h"

namespace mars::importer {

// Of one joint; patches of further colours stand on joints of their own, fixed to it. Refuses a file without patches.
ImportedText import_patches(const ImportOptions& options, FileKind kind, const Stance& stance);

}  // namespace mars::importer
