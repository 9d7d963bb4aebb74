// A crowd of figures that share one mesh with a skin, for peers: what MARS draws of a film, in its bones' own axes.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/bench/peers/mesh.h"

namespace mars::bench {

// It follows up to four bones; weights that are not needed are 0.
struct SkinVertex {
  std::array<float, 3> place, normal;  // scaled as the figures are
  std::array<std::uint32_t, 4> bone;
  std::array<float, 4> weight;
};

struct CrowdHead {
  MeshHead mesh;  // `patches` counts figures
  std::uint32_t bones;
};

struct Crowd {
  CrowdHead head;
  Look look;
  std::vector<SkinVertex> vertices;
  std::vector<Corners> triangles;
  std::vector<Motion> bones;  // to eye space: frame by frame, figure by figure; they turn and shift only
};

// Throw std::runtime_error that names the file.
void write_crowd(const Crowd& crowd, const std::string& path);
Crowd read_crowd(const std::string& path);

}  // namespace mars::bench
