#include "host/content/importer/import_file.h"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdio>
#include <functional>
#include <vector>

#include "hal/failure/failure.h"
#include "host/content/document/json_file.h"
#include "host/content/document/shell_word.h"
#include "host/content/document/text.h"
#include "host/content/document/whole_file.h"
#include "host/content/importer/apart.h"
#include "host/content/importer/file_kind.h"
#include "host/content/importer/import_report.h"
#include "host/content/importer/mesh_file.h"
#include "host/content/importer/model_text.h"
#include "host/content/importer/promised.h"
#include "host/content/modeler/patch_file.h"

namespace mars::importer {
namespace {

struct Imported {
  ImportReport report;
  std::string model;
};

// y up is glTF's rule and OBJ's custom.
char usual_up(FileKind kind) {
  return kind == FileKind::obj || kind == FileKind::gltf || kind == FileKind::glb ? 'y' : 'z';
}

// Turns the axis `up` into z: from y the file's x stays x; from x, as COLLADA has it, its -y becomes x.
glm::dmat3 upright(char up) {
  const glm::dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  if (up == 'x') return {z, -x, -y};
  return up == 'y' ? glm::dmat3(x, z, -y) : glm::dmat3(x, y, z);
}

std::string box_of(const glm::dvec3& extent, char up) {
  return document::formatted("%.4g x %.4g x %.4g, the file's %c upward", extent.x, extent.y, extent.z, up);
}

Imported import_patches(const ImportOptions& options, char up) {
  if (options.crease)
    throw Failure("has patches, which need no crease", options.from.string(), "leave out --crease: it is for meshes");
  const modeler::PatchFile file = modeler::read_patch_file(options.from, upright(up) * options.scale);
  return {{"model of one joint '" + options.joint + "'",
           box_of(file.extent, up),
           {document::counted(file.patches.size(), "patch", "patches")},
           {}},
          model_text({{shape_text(file.patches), {}}}, file.bounds, options.joint)};
}

std::vector<std::string> read_of(const MeshFile& file) {
  std::size_t vertices = 0, faces = 0, colors = 0;
  for (const MeshPart& part : file.parts) {
    vertices += part.mesh.vertices.size();
    faces += part.mesh.ends.size();
    colors += part.color.has_value();
  }
  const bool joined = vertices < file.vertices;
  std::vector<std::string> read = {document::counted(vertices, "vertex", "vertices") +
                                       (joined ? " of the file's " + std::to_string(file.vertices) : ""),
                                   document::counted(faces, "face", "faces")};
  if (!file.parts[0].mesh.normals.empty()) read.emplace_back("normals");
  if (colors > 0) read.push_back(document::counted(colors, "colour", "colours"));
  return read;
}

// Of the first joint, whether it has a colour or not.
std::string set_material(const ImportOptions& options) {
  return "mars model set " + document::shell_word(options.to.string()) + " " + document::shell_word(options.joint) +
         " --material " + material_name(0);
}

Imported import_mesh(const ImportOptions& options, FileKind kind, char up) {
  const MeshOptions mesh{upright(up), options.scale, options.crease, set_material(options)};
  const MeshFile file = read_mesh_file(options.from, kind, mesh);
  for (const std::filesystem::path& companion : file.companions) document::refuse_same_file(companion, options.to);
  std::vector<ImportedPart> parts;
  for (const MeshPart& part : file.parts) parts.push_back({shape_text(part.mesh), part.color});
  const std::string joints = parts.size() == 1 ? "one joint" : std::to_string(parts.size()) + " joints, the first";
  return {{"model of " + joints + " '" + options.joint + "'", box_of(file.extent, up), read_of(file), file.not_read},
          model_text(parts, file.bounds, options.joint)};
}

// Of the work on so many bytes; a sound file takes a fraction of that.
ApartLimits limits_for(std::uint64_t bytes) {
  const std::chrono::seconds processor_time(5 + (bytes >> 20));
  return {processor_time, processor_time + std::chrono::minutes(1), (std::uint64_t{1} << 30) + 64 * bytes};
}

// A library does not come back from every damaged file.
std::string read_apart(const std::filesystem::path& path, FileKind kind, const std::function<std::string()>& read) {
  constexpr const char* kRemedy = "the file may be damaged: export it again";
  std::error_code error;
  std::uint64_t bytes = std::filesystem::file_size(path, error);
  if (error) bytes = 0;
  if (kind == FileKind::gltf)
    bytes += std::stoull(
        run_apart([&] { return std::to_string(bytes_of_buffers(path)); }, limits_for(bytes), path.string(), kRemedy));
  return run_apart(read, limits_for(bytes), path.string(), kRemedy);
}

// The report, a zero, the model.
std::string run(const ImportOptions& options, FileKind kind, char up) {
  const Imported imported = kind == FileKind::patches ? import_patches(options, up) : import_mesh(options, kind, up);
  return text_of(imported.report, options.to.string()) + '\0' + imported.model;
}

bool is_utf8(const std::string& text) {
  return document::Json::parse(document::Json(text).dump(-1, ' ', false, document::Json::error_handler_t::replace)) ==
         text;
}

// `given` is the name that a person gave; "": the joint is named as the file.
void check_joint(const std::string& joint, const std::string& given, const std::filesystem::path& from) {
  constexpr std::size_t kMost = 90;  // of a name's 100 bytes: numbers may follow
  const bool plain = !joint.empty() && joint.size() <= kMost && joint.find('/') == std::string::npos &&
                     std::none_of(joint.begin(), joint.end(), [](unsigned char c) { return std::iscntrl(c); }) &&
                     is_utf8(joint);
  if (plain) return;
  const std::string name = "'" + document::printable(joint) + "'";
  constexpr const char* kNames = "of 1 to 90 bytes of UTF-8, without '/' and ends of lines";
  if (given.empty())
    throw Failure("its name, " + name + ", cannot name a joint", document::printable(from.string()),
                  std::string("give the joint a name with --joint: one ") + kNames);
  throw Failure("cannot name a joint", "--joint " + name, std::string("choose a name ") + kNames);
}

void check_target(const ImportOptions& options) {
  document::refuse_same_file(options.from, options.to);
  std::error_code none;
  if (!options.force && std::filesystem::exists(options.to, none))
    throw Failure("is there already", options.to.string(), "choose another name, or replace it with --force");
  document::check_can_write(options.to);
}

}  // namespace

std::string import_model(const ImportOptions& given) {
  ImportOptions options = given;
  const FileKind kind = kind_of_name(options.from);
  if (options.joint.empty()) options.joint = options.from.stem().string();
  check_joint(options.joint, given.joint, given.from);
  check_first_bytes(options.from, kind);
  check_target(options);
  const char up = options.up.value_or(usual_up(kind));
  const std::string answer = read_apart(options.from, kind, [&] { return run(options, kind, up); });
  const std::size_t end = answer.find('\0');
  document::write_whole_file(options.to, std::string_view(answer).substr(end + 1));
  return answer.substr(0, end);
}

}  // namespace mars::importer
