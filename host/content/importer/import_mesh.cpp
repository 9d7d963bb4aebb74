#include "host/content/importer/import_mesh.h"

#include <filesystem>

#include "host/content/document/shell_word.h"
#include "host/content/document/text.h"
#include "host/content/document/whole_file.h"
#include "host/content/importer/joint_names.h"
#include "host/content/importer/mesh_file.h"
#include "host/content/importer/model_text.h"

namespace mars::importer {
namespace {

std::vector<std::string> read_of(const MeshFile& file) {
  std::size_t vertices = 0, faces = 0;
  bool has_normals = false;
  for (const MeshJoint& joint : file.joints) {
    if (!joint.part) continue;
    vertices += joint.part->mesh.vertices.size();
    faces += joint.part->mesh.ends.size();
    has_normals = !joint.part->mesh.normals.empty();
  }
  const bool joined = vertices < file.vertices;
  std::vector<std::string> read = {document::counted(vertices, "vertex", "vertices") +
                                       (joined ? " of the file's " + std::to_string(file.vertices) : ""),
                                   document::counted(faces, "face", "faces")};
  if (has_normals) read.emplace_back("normals");
  if (!file.materials.empty()) read.push_back(document::counted(file.materials.size(), "colour", "colours"));
  return read;
}

std::vector<std::string> kept_of(const MeshFile& file) {
  std::size_t places = 0, colors = 0;
  for (const MeshJoint& joint : file.joints) {
    if (!joint.part) continue;
    places += joint.part->paint.uv.size();
    colors += joint.part->paint.colors.size();
  }
  std::vector<std::string> kept;
  if (places > 0) kept.push_back(document::counted(places, "place u,v in images", "places u,v in images"));
  if (colors > 0) kept.push_back(document::counted(colors, "vertex's colour", "vertices' colours"));
  if (!file.images.empty())
    kept.push_back(document::counted(file.images.size(), "image", "images") + " in " +
                   std::filesystem::path(file.images[0].file).parent_path().string());
  return kept;
}

// Of the first joint, whether it has a colour or not.
std::string set_material(const ImportOptions& options) {
  return "mars model " + document::shell_word(options.to.string()) + " set " + document::shell_word(options.joint) +
         " --material " + material_name(0);
}

std::string set_limb(const ImportOptions& options) {
  if (options.as == ImportAs::film)
    return "import it as a model, NAME.json, then mars model NAME.json set JOINT --limb";
  return "mars model " + document::shell_word(options.to.string()) + " set JOINT --limb";
}

WrittenSkin skin_of(const MeshFile& file) {
  WrittenSkin skin;
  for (const MeshBone& bone : file.bones) {
    skin.joints.push_back(file.joints[bone.joint].name);
    if (!file.are_bound_at_rest) skin.binds.push_back(bone.bind);
  }
  return skin;
}

}  // namespace

std::string box_text(const glm::dvec3& extent, double factor, FileKind kind, const Stance& stance) {
  std::string text = document::formatted("%.4g x %.4g x %.4g units", extent.x, extent.y, extent.z);
  if (has_nodes(kind))
    text += document::formatted(", %.4g m tall", extent.z / factor) + (factor == 1 ? "" : " in the file");
  return text + ", the file's " + stance.up + " upward";
}

MeshFile read_mesh(const ImportOptions& options, FileKind kind, const Stance& stance, std::vector<glm::dmat4> rest) {
  const bool looks_ahead = options.front.empty() && rest.empty();
  MeshFile file = read_mesh_file(options.from, kind,
                                 {stance.upright, options.size, options.crease, options.joint, set_material(options),
                                  set_limb(options), document::in_utf8(options.to.stem().string()) + "-images",
                                  std::move(rest), looks_ahead});
  for (const std::filesystem::path& companion : file.companions) document::refuse_same_file(companion, options.to);
  return file;
}

document::LongText model_text_of(MeshFile& file) {
  std::vector<WrittenJoint> joints;
  for (MeshJoint& joint : file.joints) {
    joints.push_back({joint.name, joint.parent, joint.frame, joint.fixed, {}, joint.limits});
    if (joint.part)
      joints.back().segment =
          WrittenSegment{shape_text(joint.part->mesh, joint.part->paint), joint.part->bounds, joint.part->material, {}};
    if (joint.has_skin) joints.back().segment->skin = skin_of(file);
    if (joint.part) joint.part->mesh = {}, joint.part->paint = {};
  }
  return model_text(std::move(joints), file.materials, file.limbs);
}

ImportReport report_of(const MeshFile& file, FileKind kind, const Stance& stance) {
  return {"", box_text(file.extent, file.factor, kind, stance), read_of(file), file.made, kept_of(file), file.not_read};
}

ImportedText import_mesh(const ImportOptions& options, FileKind kind, const Stance& stance) {
  MeshFile file = read_mesh(options, kind, stance);
  ImportReport report = report_of(file, kind, stance);
  const std::size_t joints = file.joints.size();
  const std::string count = joints == 1 ? "one joint" : std::to_string(joints) + " joints, the first";
  report.model = "model of " + count + " '" + options.joint + "'";
  document::LongText text = model_text_of(file);
  return {std::move(report), std::move(text), std::move(file.images)};
}

}  // namespace mars::importer
