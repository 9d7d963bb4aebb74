// A model: a tree of joints, each with at most one base segment. What a model file holds, with names resolved
// and primitives made into patches. How joints stand in one another: joint.h.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/content/modeler/joint.h"
#include "host/content/modeler/limbs.h"
#include "host/content/modeler/material.h"
#include "host/content/modeler/mesh.h"
#include "node/wire/film.h"

namespace mars::modeler {

// Patches or a mesh in the unit cube, shared by all segments that name them.
struct Shape {
  std::string name;
  std::vector<wire::Patch> patches;
  std::optional<Mesh> mesh{};
};

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

// Whether the joint is `above`, or hangs below it; false if there is no `above` (kNone).
bool is_at_or_below(std::span<const Joint> joints, std::size_t joint, std::size_t above);

}  // namespace mars::modeler
