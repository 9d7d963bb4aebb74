// Meshes on their way to a film: faces in triangles, normals at corners, meshlets.
#include "host/content/modeler/mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "host/content/modeler/mesh_normals.h"
#include "host/content/modeler/meshlets.h"

namespace mars::modeler {
namespace {

using Place = Mesh::Place;

Mesh mesh_of(std::vector<Place> vertices, const std::vector<std::vector<std::uint32_t>>& faces, double crease = 30) {
  Mesh mesh;
  mesh.vertices = std::move(vertices);
  mesh.crease = crease;
  for (const auto& face : faces) {
    mesh.corners.insert(mesh.corners.end(), face.begin(), face.end());
    mesh.ends.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
  }
  return mesh;
}

Mesh cube(double crease) {
  std::vector<Place> vertices;
  for (int k = 0; k < 8; ++k) vertices.push_back({float(k & 1), float(k >> 1 & 1), float(k >> 2)});
  return mesh_of(vertices, {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}},
                 crease);
}

// A wavy square of n x n quads: each twice as many triangles.
Mesh sheet(std::uint32_t n) {
  std::vector<Place> vertices;
  std::vector<std::vector<std::uint32_t>> faces;
  for (std::uint32_t j = 0; j <= n; ++j)
    for (std::uint32_t i = 0; i <= n; ++i)
      vertices.push_back({float(i) / n, float(j) / n, 0.5f + 0.1f * std::sin(9.0f * i / n) * std::cos(7.0f * j / n)});
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = j * (n + 1) + i;
      faces.push_back({a, a + 1, a + n + 2, a + n + 1});
    }
  return mesh_of(vertices, faces, 180);
}

// One face over these points, in the plane that `place` puts them in.
template <typename Lift>
Mesh face_over(const std::vector<std::array<double, 2>>& points, const Lift& lift) {
  std::vector<Place> vertices;
  std::vector<std::uint32_t> face;
  for (const auto& [x, y] : points) {
    face.push_back(static_cast<std::uint32_t>(vertices.size()));
    vertices.push_back(lift(float(x), float(y)));
  }
  return mesh_of(vertices, {face});
}

Place flat(float x, float y) { return {x, y, 0}; }

double area2(const std::vector<std::array<double, 2>>& p, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  return (p[b][0] - p[a][0]) * (p[c][1] - p[a][1]) - (p[c][0] - p[a][0]) * (p[b][1] - p[a][1]);
}

const std::vector<std::array<double, 2>> kComb = {{0, 0},   {1, 0},   {1, 1},     {0.8, 1},   {0.8, 0.2}, {0.6, 0.2},
                                                  {0.6, 1}, {0.4, 1}, {0.4, 0.2}, {0.2, 0.2}, {0.2, 1},   {0, 1}};

TEST(Split, ConcaveFacesAreTiledOnce) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 300; ++trial) {
    // A star-shaped outline round the middle, or a comb, whose ears lie far apart.
    std::vector<std::array<double, 2>> points = kComb;
    if (trial > 0) {
      points.clear();
      const int count = 3 + static_cast<int>(random() % 40);
      for (int k = 0; k < count; ++k) {
        const double angle = 2 * std::numbers::pi * k / count, radius = 0.05 + 0.45 * (random() % 1000) / 1000.0;
        points.push_back({float(0.5 + radius * std::cos(angle)), float(0.5 + radius * std::sin(angle))});
      }
    }
    double whole = 0, sum = 0;
    for (std::uint32_t k = 1; k + 1 < points.size(); ++k) whole += area2(points, 0, k, k + 1);
    const Mesh mesh = face_over(points, flat);
    const auto triangles = split(mesh, mesh.face(0));
    ASSERT_TRUE(triangles.has_value()) << "trial " << trial;
    EXPECT_EQ(triangles->size(), points.size() - 2);
    for (const auto& [a, b, c] : *triangles) {
      const double area = area2(points, a, b, c);
      EXPECT_GE(area, 0) << "trial " << trial << ": no triangle is turned over";
      sum += area;
    }
    EXPECT_NEAR(sum, whole, 1e-6) << "trial " << trial << ": none overlap";
  }
}

TEST(Split, WhateverPlaneTheFaceLiesIn) {
  const auto count = [&](const Mesh& mesh) { return split(mesh, mesh.face(0)).value().size(); };
  EXPECT_EQ(count(face_over(kComb, [](float x, float y) { return Place{0, x, y}; })), 10u);
  EXPECT_EQ(count(face_over(kComb, [](float x, float y) { return Place{y, 0, x}; })), 10u);
  EXPECT_EQ(count(face_over(kComb, [](float x, float y) { return Place{y, x, 0}; })), 10u) << "seen from below";
  EXPECT_EQ(count(face_over(kComb, [](float x, float y) { return Place{x, y, (x + y) / 2}; })), 10u);
}

TEST(Split, OutlinesThatCrossAreRefused) {
  const Mesh bow = face_over({{0, 0}, {1, 1}, {1, 0}, {0, 1}}, flat);
  EXPECT_FALSE(split(bow, bow.face(0)));
  const Mesh knot = face_over({{0, 0}, {1, 0}, {1, 1}, {0.2, 0.4}, {0.8, 0.3}, {0, 1}}, flat);
  EXPECT_FALSE(split(knot, knot.face(0)));
}

TEST(Split, ManyCornersTakeNoTime) {
  std::vector<std::array<double, 2>> gear;
  for (std::size_t k = 0; k < kMostCorners; ++k) {
    const double angle = 2 * std::numbers::pi * double(k) / double(kMostCorners), radius = k % 2 ? 0.5 : 0.45;
    gear.push_back({0.5 + radius * std::cos(angle), 0.5 + radius * std::sin(angle)});
  }
  const Mesh mesh = face_over(gear, flat);
  EXPECT_EQ(split(mesh, mesh.face(0)).value().size(), kMostCorners - 2);
}

TEST(Normals, ACubesEdgesStaySharpOrNot) {
  const ShadedVertices sharp = shaded_vertices(cube(89)), smooth = shaded_vertices(cube(90));
  EXPECT_EQ(sharp.places.size(), 24u);
  for (const Place& n : sharp.normals)
    EXPECT_EQ(std::abs(n[0]) + std::abs(n[1]) + std::abs(n[2]), 1) << "along an axis";
  ASSERT_EQ(smooth.places.size(), 8u);
  for (std::size_t k = 0; k < 8; ++k)
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(smooth.normals[k][axis], (smooth.places[k][axis] * 2 - 1) / std::sqrt(3.0), 1e-6) << "outward";
}

TEST(Normals, HowAFaceIsSplitDoesNotMatter) {
  Mesh quads = cube(180), triangles = cube(180);
  triangles.corners.clear();
  triangles.ends.clear();
  for (std::size_t f = 0; f < 6; ++f) {
    const auto q = quads.face(f);
    for (const std::uint32_t corner : {q[0], q[1], q[2], q[0], q[2], q[3]}) triangles.corners.push_back(corner);
    triangles.ends.push_back(static_cast<std::uint32_t>(triangles.corners.size() - 3));
    triangles.ends.push_back(static_cast<std::uint32_t>(triangles.corners.size()));
  }
  const ShadedVertices one = shaded_vertices(quads), other = shaded_vertices(triangles);
  ASSERT_EQ(other.places.size(), 8u);
  std::map<Place, Place> normals;
  for (std::size_t k = 0; k < 8; ++k) normals[one.places[k]] = one.normals[k];
  for (std::size_t k = 0; k < 8; ++k)
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(other.normals[k][axis], normals.at(other.places[k])[axis], 1e-6) << "angles weigh, not faces";
}

// Two sheets that meet in a ridge are smooth each, also where every face has vertices of its own.
TEST(Normals, VerticesAtOnePlaceAreOne) {
  Mesh mesh = sheet(6);
  Mesh apart = mesh;
  apart.vertices.clear();
  apart.corners.clear();
  for (const std::uint32_t corner : mesh.corners) {
    apart.corners.push_back(static_cast<std::uint32_t>(apart.vertices.size()));
    apart.vertices.push_back(mesh.vertices[corner]);
  }
  const ShadedVertices one = shaded_vertices(mesh), other = shaded_vertices(apart);
  EXPECT_EQ(one.places, other.places);
  EXPECT_EQ(one.normals, other.normals);
  EXPECT_EQ(one.places.size(), 49u);
}

// Where three faces share an edge, or two run it the same way, no normal is theirs together.
TEST(Normals, EdgesThatAreNoSurfacesStaySharp) {
  const std::vector<Place> v = {{0, 0, 0}, {1, 0, 0}, {0.5f, 1, 0}, {0.5f, 0.9f, 0.1f}, {0.5f, 0.9f, 0.3f}};
  EXPECT_EQ(shaded_vertices(mesh_of(v, {{0, 1, 2}, {1, 0, 3}, {1, 0, 4}}, 180)).places.size(), 9u);
  EXPECT_EQ(shaded_vertices(mesh_of(v, {{0, 1, 2}, {0, 1, 3}}, 180)).places.size(), 6u);
  EXPECT_EQ(shaded_vertices(mesh_of(v, {{0, 1, 2}, {1, 0, 3}}, 180)).places.size(), 4u);
}

// A face without area between two others passes their normals on; it has none of its own.
TEST(Normals, AFaceWithoutAreaIsNoEdge) {
  const std::vector<Place> v = {{0, 0, 0}, {0.5f, 0, 0}, {1, 0, 0}, {0.5f, 1, 0}, {0.5f, 0, 1}};
  const ShadedVertices shaded = shaded_vertices(mesh_of(v, {{0, 2, 3}, {0, 1, 2}, {1, 0, 4}, {2, 1, 4}}, 180));
  for (const Place& n : shaded.normals) EXPECT_NEAR(n[0] * n[0] + n[1] * n[1] + n[2] * n[2], 1, 1e-6);
}

TEST(MeshletCutting, EveryTriangleOnceWithinItsBox) {
  for (const std::uint32_t n : {1u, 8u, 40u, 150u})
    for (const double crease : {0.0, 180.0}) {
      Mesh mesh = sheet(n);
      mesh.crease = crease;
      const Meshlets cut = cut_meshlets(mesh);
      EXPECT_EQ(cut.triangles.size(), 2 * n * n);
      EXPECT_EQ(cut.places.size(), cut.normals.size());
      std::uint32_t vertices = 0, triangles = 0;
      std::map<Place, double> angles;  // a sixth of what is round a vertex belongs to each of its triangles
      for (const wire::Meshlet& m : cut.meshlets) {
        EXPECT_EQ(m.first_vertex, vertices);
        EXPECT_EQ(m.first_triangle, triangles);
        EXPECT_LE(m.vertex_count, wire::kMeshletVertices);
        EXPECT_LE(m.triangle_count, wire::kMeshletTriangles);
        for (std::uint32_t t = 0; t < m.triangle_count; ++t)
          for (const std::uint8_t corner : cut.triangles[m.first_triangle + t]) {
            ASSERT_LT(corner, m.vertex_count);
            const Place& place = cut.places[m.first_vertex + corner];
            ++angles[place];
            for (std::size_t axis = 0; axis < 3; ++axis)
              EXPECT_TRUE(m.low[axis] <= place[axis] && place[axis] <= m.high[axis]);
          }
        vertices += m.vertex_count;
        triangles += m.triangle_count;
      }
      EXPECT_EQ(vertices, cut.places.size());
      EXPECT_EQ(triangles, cut.triangles.size());
      EXPECT_EQ(angles.size(), mesh.vertices.size()) << "places are the file's, bit for bit";
      if (n >= 40) {
        EXPECT_LT(cut.meshlets.size(), (crease == 0 ? 1.6 : 1.3) * 2 * n * n / (crease == 0 ? 64 : 128))
            << "nearly full";
      }
    }
}

TEST(MeshletCutting, GivenNormalsAreTaken) {
  Mesh mesh = cube(30);
  for (const Place& v : mesh.vertices) mesh.normals.push_back({v[0] - 0.5f, v[1] - 0.5f, v[2] - 0.5f});
  const Meshlets cut = cut_meshlets(mesh);
  ASSERT_EQ(cut.places.size(), 8u);
  for (std::size_t k = 0; k < 8; ++k) EXPECT_EQ(cut.normals[k][0], cut.places[k][0] - 0.5f);
}

}  // namespace
}  // namespace mars::modeler
