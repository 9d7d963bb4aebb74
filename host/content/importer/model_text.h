// The model file that `mars import` writes. Its numbers are many, so they go straight into text.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/content/importer/imported_mesh.h"
#include "host/content/document/long_text.h"
#include "node/wire/film.h"

namespace mars::importer {

struct WrittenSkin {
  std::vector<std::string> joints;     // their names
  std::vector<modeler::Affine> binds;  // of each; none: the mesh is where it is at rest
};

struct WrittenSegment {
  document::TextPart
      shape;  // JSON; segments of the same text share a shape, such as a wheel that a file has four times
  modeler::Box sbb;
  std::optional<std::size_t> material;  // of the model's materials
  std::optional<WrittenSkin> skin{};
};

struct WrittenJoint {
  std::string name;    // in UTF-8
  std::string parent;  // "": none
  JointFrame frame;
  bool fixed = false;  // it cannot turn
  std::optional<WrittenSegment> segment;
  std::optional<std::array<modeler::Limits, 3>> limits{};  // of one that is not fixed; none: it turns freely
};

// Of material 0, 1, ...
std::string material_name(std::size_t number);

// A shape as JSON. In brief patches are the first one, and a mesh is a triangle that follows as many bones.
document::TextPart shape_text(const std::vector<wire::Patch>& patches);
document::TextPart shape_text(const modeler::Mesh& mesh, const MeshPaint& paint = {});

document::LongText model_text(std::vector<WrittenJoint> joints, const std::vector<ImportedMaterial>& materials,
                              const std::vector<NamedLimb>& limbs = {});

}  // namespace mars::importer
