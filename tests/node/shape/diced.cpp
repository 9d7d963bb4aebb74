#include "tests/node/shape/diced.h"

#include <utility>

#include <gtest/gtest.h>

namespace mars::shape {
namespace {

Vec3 place_of(const Vertices& v, std::uint32_t k) { return {v.place[0][k], v.place[1][k], v.place[2][k]}; }

}  // namespace

Mesh mesh_of(const Dicer& diced) {
  Mesh mesh;
  const auto number = [&](std::uint32_t vertex) {
    const Vec3 place = place_of(diced.vertices(), vertex);
    const auto [at, added] = mesh.numbers.try_emplace(place, static_cast<int>(mesh.places.size()));
    if (added) mesh.places.push_back(place);
    return at->second;
  };
  for (std::uint32_t k = 0; k < diced.triangles().count; ++k) {
    const Corner3 corner = diced.triangles()[k];
    mesh.faces.push_back({number(corner.a), number(corner.b), number(corner.c)});
  }
  return mesh;
}

std::map<int, int> boundary(const Mesh& mesh) {
  std::set<std::pair<int, int>> edges;
  for (const auto& face : mesh.faces)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_TRUE(edges.emplace(face[k], face[(k + 1) % 3]).second) << "an edge runs twice the same way";
  std::map<int, int> next;
  for (const auto& [from, to] : edges)
    EXPECT_TRUE(edges.contains({to, from}) || next.emplace(from, to).second) << "the boundary branches";
  return next;
}

bool sound_disc(const Mesh& mesh, const EyePatch& patch, const Rates& rates) {
  const auto next = boundary(mesh);
  const auto corner = [&](int k) { return mesh.numbers.at({patch.point[k][0], patch.point[k][1], patch.point[k][2]}); };
  const int corners[] = {corner(0), corner(3), corner(15), corner(12), corner(0)};
  std::size_t steps = 0;
  for (std::size_t side = 0; side < 4; ++side) {
    int at = corners[side];
    for (int step = 0; step < rates.side[side]; ++step, ++steps) {
      if (!next.contains(at)) return ADD_FAILURE() << "the boundary ends on side " << side, false;
      at = next.at(at);
    }
    EXPECT_EQ(at, corners[side + 1]) << "side " << side << " has not the steps of its rate";
  }
  EXPECT_EQ(next.size(), steps) << "the mesh has a hole or a T-joint";
  // Euler: V - E + F = 1, where 2 E = 3 F + boundary.
  const std::size_t edges = (3 * mesh.faces.size() + next.size()) / 2;
  EXPECT_EQ(mesh.places.size() + mesh.faces.size(), edges + 1) << "the mesh is no disc";
  return !testing::Test::HasFailure();
}

std::set<ScreenVertex> boundary_vertices(const Dicer& diced) {
  const Mesh mesh = mesh_of(diced);
  const auto next = boundary(mesh);
  const Vertices& v = diced.vertices();
  std::set<ScreenVertex> vertices;
  for (std::uint32_t t = 0; t < diced.triangles().count; ++t) {
    const Corner3 corners = diced.triangles()[t];
    for (const std::uint32_t k : {corners.a, corners.b, corners.c})
      if (next.contains(mesh.numbers.at(place_of(v, k))))
        vertices.insert({{v.place[0][k], v.place[1][k], v.place[2][k]}, v.x[k], v.y[k], v.values[k][kDepth]});
  }
  return vertices;
}

}  // namespace mars::shape
