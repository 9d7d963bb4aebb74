#include "host/content/importer/mesh_file.h"

#include <limits>

#include "host/content/importer/model_builder.h"
#include "host/content/importer/ply_file.h"
#include "host/content/importer/scene_file.h"

namespace mars::importer {
namespace {

CornerPaint paint_of(const PlyFile& ply, std::uint32_t vertex) {
  CornerPaint paint;
  if (!ply.uv.empty()) paint.uv = ply.uv[vertex];
  if (!ply.colors.empty()) paint.color = ply.colors[vertex];
  return paint;
}

MeshFile read_ply(const std::filesystem::path& path, const MeshOptions& options) {
  const PlyFile ply = read_ply_file(path);
  ModelBuilder builder(path.string(), options, !ply.normals.empty(), modeler::kDefaultCrease);
  MeshBuilder& mesh = builder.mesh(builder.add_joint(options.joint, modeler::kNone, {}));
  const std::size_t part = mesh.part_of({});
  constexpr auto kNew = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> numbers(ply.places.size(), kNew), face;
  for (std::size_t f = 0, c = 0; f < ply.ends.size(); ++f) {
    for (face.clear(); c < ply.ends[f]; ++c) {
      const std::uint32_t corner = ply.corners[c];
      if (numbers[corner] == kNew)
        numbers[corner] = mesh.corner(part, options.upright * ply.places[corner],
                                      ply.normals.empty() ? glm::dvec3(0) : options.upright * ply.normals[corner],
                                      nullptr, paint_of(ply, corner));
      face.push_back(numbers[corner]);
    }
    mesh.add_face(part, face);
  }
  MeshFile file = builder.finish();
  file.vertices = ply.places.size();
  file.not_read.insert(file.not_read.end(), ply.not_read.begin(), ply.not_read.end());
  return file;
}

}  // namespace

MeshFile read_mesh_file(const std::filesystem::path& path, FileKind kind, const MeshOptions& options) {
  return kind == FileKind::ply ? read_ply(path, options) : read_scene_file(path, kind, options);
}

}  // namespace mars::importer
