// The dicing step: a node's share of the patches, scattered as i, i + P, i + 2P ..., becomes triangles, their
// edge boxes counted line by line.
#pragma once

#include "node/dice.h"
#include "node/protocol.h"
#include "node/scene.h"
#include "node/setup.h"

namespace mars::node {

enum class Part { stationary, moving };

// Patches whose number is `index` modulo `count`.
struct Scatter {
  std::uint32_t index = 0;
  std::uint32_t count = 1;
};

class PolygonMaker {
 public:
  explicit PolygonMaker(const Kernels& kernels);

  // Triangles of `part`'s patches at the scene's frame, in the order of polygon numbers. Counts what it did
  // into `work`.
  void make(const Scene& scene, Part part, const Scatter& scatter, SetUps& out, WorkCounts& work);

 private:
  const Kernels& kernels_;
  Dicer dicer_;
};

}  // namespace mars::node
