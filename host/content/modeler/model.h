// A model: a tree of joints, each with at most one base segment. What a model file holds, with names resolved
// and primitives made into patches. How joints stand in one another: joint.h.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/content/modeler/joint.h"
#include "host/content/modeler/limbs.h"
#include "host/content/modeler/material.h"
#include "host/content/modeler/mesh.h"
#include "host/content/modeler/control_net.h"
#include "node/wire/film.h"

namespace mars::modeler {

// Patches or a mesh in the unit cube, shared by all segments that name them.
struct Shape {
  std::string name;
  std::vector<wire::Patch> patches;
  std::optional<Mesh> mesh{};
  std::optional<ControlNet> net{};  // of a skin of patches: how these bend

  bool has_skin() const { return net || (mesh && !mesh->bones.empty()); }
};

// The greatest number of a bone that a shape with a skin has.
std::uint32_t last_bone(const Shape& shape);

struct NamedMaterial {
  std::string name;
  wire::Material material;
};

struct Model {
  std::vector<Joint> joints;
  std::vector<Shape> shapes;
  std::vector<NamedMaterial> materials;
  Limbs limbs{};
};

}  // namespace mars::modeler
