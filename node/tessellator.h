// The dicing step: a node's share of the patches and meshlets, scattered as i, i + P, i + 2P ..., becomes triangles,
// their edge boxes counted line by line.
#pragma once

#include "node/shape/dice.h"
#include "node/geometry/meshlets.h"
#include "node/wire/protocol.h"
#include "node/geometry/scene.h"
#include "node/raster/setup.h"

namespace mars::node {

enum class Part { stationary, moving };

// Patches and meshlets whose number is `index` modulo `count`.
struct Scatter {
  std::uint32_t index = 0;
  std::uint32_t count = 1;
};

class Tessellator {
 public:
  explicit Tessellator(InstructionSet set);

  // Triangles of `part`'s patches and meshlets at the scene's frame, in the order of polygon numbers. Counts what it did
  // into `work`.
  void make(const Scene& scene, Part part, const Scatter& scatter, SetUps& out, WorkCounts& work);

 private:
  InstructionSet instruction_set_;
  Dicer dicer_;
  MeshletPlacer placer_;
};

}  // namespace mars::node
