// A diced patch as a mesh: vertices that lie at the same place are one.
#pragma once

#include <array>
#include <map>
#include <set>
#include <vector>

#include "node/shape/dice.h"
#include "tests/node/shape/patches.h"

namespace mars::shape {

struct Mesh {
  std::vector<Vec3> places;               // of its vertices, all different
  std::map<Vec3, int> numbers;            // of the vertices by their places
  std::vector<std::array<int, 3>> faces;  // counter-clockwise seen from outside
};

Mesh mesh_of(const Dicer& diced);

// Directed edges that no other triangle has the other way round: from -> to. Counter-clockwise round the
// mesh. Fails the test where an edge occurs twice in one direction.
std::map<int, int> boundary(const Mesh& mesh);

// Checks that the mesh is a disc without T-joints whose boundary runs through the patch's corners in order,
// each side in as many steps as its rate says; false where the test has failed.
bool sound_disc(const Mesh& mesh, const EyePatch& patch, const Rates& rates);

// What a side's vertices are in full: place, screen place and 1 / w, in no order.
struct ScreenVertex {
  std::array<float, 3> place;
  std::int32_t x, y;
  float inverse_w;
  auto operator<=>(const ScreenVertex&) const = default;
};
std::set<ScreenVertex> boundary_vertices(const Dicer& diced);

}  // namespace mars::shape
