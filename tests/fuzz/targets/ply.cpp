// PLY files, and the meshes made of them.
#include "host/content/importer/mesh_file.h"
#include "host/content/importer/model_text.h"
#include "tests/fuzz/scratch.h"
#include "tests/fuzz/target.h"

namespace mars::fuzz::ply {

void take(std::string_view input) {
  const auto path = scratch().file("mesh.ply", input);
  const importer::MeshFile file = importer::read_mesh_file(path, importer::FileKind::ply, {});
  for (const importer::MeshJoint& joint : file.joints)
    if (joint.part) importer::shape_text(joint.part->mesh);
}

const Target target("ply", Form::text, take);

}  // namespace mars::fuzz::ply
