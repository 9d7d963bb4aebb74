#include "host/content/importer/import_patches.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <map>
#include <optional>
#include <utility>

#include "hal/failure/failure.h"
#include "host/content/document/fields.h"
#include "host/content/document/text.h"
#include "host/content/importer/joint_names.h"
#include "host/content/importer/mesh_builder.h"
#include "host/content/importer/model_text.h"
#include "host/content/importer/patches/patch_scene.h"
#include "host/content/modeler/patch_file.h"

namespace mars::importer {
namespace {

ImportedText import_bpt(const ImportOptions& options, FileKind kind, const Stance& stance) {
  const auto read = [&](double factor) { return modeler::read_patch_file(options.from, stance.upright * factor); };
  const double factor = options.size.factor(options.size.height ? read(1).extent.z : 0, options.from.string());
  const modeler::PatchFile file = read(factor);
  return {{"model of one joint '" + options.joint + "'",
           box_text(file.extent, factor, kind, stance),
           {document::counted(file.patches.size(), "patch", "patches")},
           {},
           {},
           {}},
          model_text({{options.joint, "", {}, false, WrittenSegment{shape_text(file.patches), file.bounds, {}}}}, {})};
}

// In our axes, where z is up. What the mirror turns inside out is turned back: u and v change places.
void place(PatchScene& scene, const glm::dmat3& upright) {
  glm::dmat3 mirror(1);
  if (scene.is_left_handed) mirror[2][2] = -1;
  transform(scene.patches, glm::dmat4(upright * mirror));
  if (!scene.is_left_handed) return;
  for (ScenePatch& patch : scene.patches)
    for (std::size_t u = 0; u < 4; ++u)
      for (std::size_t v = u + 1; v < 4; ++v) std::swap(patch.points[4 * v + u], patch.points[4 * u + v]);
}

// What a file computes may be infinite, or no number at all.
void check_places(const PatchScene& scene, const std::string& file) {
  for (const ScenePatch& patch : scene.patches)
    for (const glm::dvec3& point : patch.points)
      for (int axis = 0; axis < 3; ++axis)
        if (!(std::abs(point[axis]) <= document::kFarthest))
          throw Failure("has a patch with a point at " + document::shown(point[axis]), file,
                        "keep points within 1e9 of the origin, with a smaller --scale if need be");
}

modeler::Box box_of(const PatchScene& scene) {
  modeler::Box box = kEmptyBox;
  for (const ScenePatch& patch : scene.patches)
    for (const glm::dvec3& point : patch.points) box = {glm::min(box.min, point), glm::max(box.max, point)};
  return box;
}

wire::Patch in_box(const ScenePatch& patch, const modeler::Box& bounds) {
  wire::Patch in{};
  for (std::size_t i = 0; i < 16; ++i)
    for (int axis = 0; axis < 3; ++axis)
      in.points[i][std::size_t(axis)] = static_cast<float>(
          std::clamp((patch.points[i][axis] - bounds.min[axis]) / (bounds.max[axis] - bounds.min[axis]), 0.0, 1.0));
  return in;
}

// The patches of one colour.
struct OneColor {
  std::optional<PatchColor> color;
  std::vector<wire::Patch> patches;
};

std::vector<OneColor> by_color(const PatchScene& scene, const modeler::Box& bounds) {
  std::vector<OneColor> colors;
  std::map<std::optional<PatchColor>, std::size_t> numbers;  // in `colors`
  for (const ScenePatch& patch : scene.patches) {
    std::optional<PatchColor> color = patch.color;
    for (std::size_t i = 0; color && i < 3; ++i) (*color)[i] = std::round((*color)[i] * 1000) / 1000;
    const auto [number, is_new] = numbers.try_emplace(color, colors.size());
    if (is_new) colors.push_back({color, {}});
    colors[number->second].patches.push_back(in_box(patch, bounds));
  }
  return colors;
}

document::LongText model_of(const std::string& joint, const std::vector<OneColor>& colors, const modeler::Box& bounds) {
  std::vector<WrittenJoint> joints;
  std::vector<ImportedMaterial> materials;
  JointNames names;
  for (const OneColor& each : colors) {
    WrittenSegment segment{shape_text(each.patches), bounds, {}};
    if (each.color) {
      segment.material = materials.size();
      materials.push_back({*each.color, {}});
    }
    const bool is_first = joints.empty();
    joints.push_back({names.unused(joint), is_first ? "" : joint, {}, !is_first, std::move(segment)});
  }
  return model_text(std::move(joints), materials);
}

std::vector<std::string> skipped_text(const PatchScene& scene) {
  std::vector<std::string> list;
  for (const auto& [name, count] : scene.skipped) list.push_back(std::to_string(count) + " " + name);
  return list;
}

}  // namespace

ImportedText import_patches(const ImportOptions& options, FileKind kind, const Stance& stance) {
  if (options.crease)
    throw Failure("has patches, which need no crease", options.from.string(), "leave out --crease: it is for meshes");
  if (kind == FileKind::patches) return import_bpt(options, kind, stance);
  PatchScene scene = kind == FileKind::pov ? read_pov(options.from) : read_rib(options.from);
  if (scene.patches.empty())
    throw Failure("has no bicubic patches", options.from.string(),
                  "only these can be read: export others as glTF or OBJ from the program that made it");
  place(scene, stance.upright);
  check_places(scene, options.from.string());
  const modeler::Box in_file = box_of(scene);
  const double factor = options.size.factor(in_file.max.z - in_file.min.z, options.from.string());
  transform(scene.patches, glm::dmat4(glm::dmat3(factor)));
  check_places(scene, options.from.string());
  const modeler::Box box = box_of(scene), bounds = modeler::thickened(box);
  const std::vector<OneColor> colors = by_color(scene, bounds);
  const std::size_t count = std::exchange(scene.patches, {}).size();  // their memory is needed for text
  ImportReport report{colors.size() == 1
                          ? "model of one joint '" + options.joint + "'"
                          : "model of " + std::to_string(colors.size()) + " joints, the first '" + options.joint + "'",
                      box_text(box.max - box.min, factor, kind, stance),
                      {document::counted(count, "patch", "patches")},
                      {},
                      {},
                      skipped_text(scene)};
  const auto given = std::ranges::count_if(colors, [](const OneColor& each) { return each.color.has_value(); });
  if (given > 0) report.read.push_back(document::counted(static_cast<std::size_t>(given), "colour", "colours"));
  return {std::move(report), model_of(options.joint, colors, bounds)};
}

}  // namespace mars::importer
