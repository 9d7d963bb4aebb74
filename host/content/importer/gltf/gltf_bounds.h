// Whether a glTF file's numbers lie in its buffers. Assimp 5.2 adds places that are too large to numbers that wrap, and
// then reads memory that is not the file's.
#pragma once

#include <filesystem>

#include "host/content/importer/gltf/gltf_json.h"

namespace mars::importer {

// Throws Failure where an accessor reaches beyond its buffer view, or a view beyond its buffer.
void require_within_buffers(const std::filesystem::path& path, const Tree& gltf);

// Throws Failure where an attribute of a mesh, or of a morph target, has another type than glTF's table (3.7.2.1), or
// is of other vertices than the mesh's places; and where a second set of weights stands without the first.
void require_alike_attributes(const std::filesystem::path& path, const Tree& gltf);

}  // namespace mars::importer
