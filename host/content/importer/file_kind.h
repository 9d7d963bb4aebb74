// Which files `mars import` takes: by their name's ending, which their first bytes must not contradict.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

namespace mars::importer {

enum class FileKind { obj, stl, ply, gltf, glb, fbx, collada, patches, pov, rib, bvh, asf, amc };

constexpr bool is_gltf(FileKind kind) { return kind == FileKind::gltf || kind == FileKind::glb; }

// Scenes of nodes, with a unit, bones, animations, cameras and lights.
constexpr bool has_nodes(FileKind kind) { return is_gltf(kind) || kind == FileKind::fbx || kind == FileKind::collada; }

inline constexpr const char* kMeshKinds = "OBJ, STL, PLY, glTF, GLB, FBX, COLLADA";

// Bezier patches alone.
constexpr bool is_patches(FileKind kind) {
  return kind == FileKind::patches || kind == FileKind::pov || kind == FileKind::rib;
}

// Skeletons and their motions, without shapes.
constexpr bool is_skeleton(FileKind kind) {
  return kind == FileKind::bvh || kind == FileKind::asf || kind == FileKind::amc;
}

// Whether a path ends so, in capitals or not.
bool same_ending(const std::filesystem::path& path, std::string_view ending);

// By the ending, in capitals or not; none: it is no file that `mars import` takes, but may be a companion of one.
std::optional<FileKind> known_kind(const std::filesystem::path& path);

// The same. Refuses every other; of files of well-known programs, in a failure with the way to one that can be read.
FileKind kind_of_name(const std::filesystem::path& path);

// Refuses a file whose first bytes are another kind's; what is no file is left to its reader.
void check_first_bytes(const std::filesystem::path& path, FileKind kind);

}  // namespace mars::importer
