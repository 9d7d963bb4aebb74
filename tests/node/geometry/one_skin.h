// A film of one segment with a skin of random points and bones, for tests.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "node/geometry/meshlets.h"
#include "node/geometry/segment_place.h"
#include "node/simd/instruction_set.h"
#include "tests/node/shape/patches.h"
#include "tests/node/wire/small_film.h"

namespace mars::geometry {

constexpr shape::Projection kSeen{500, {160, 90}, 0.1f, 100, 32768, 0.9f};
constexpr std::uint32_t kVertices = 45;

inline wire::Matrix random_bone(shape::Random& random, double scale) {
  wire::Matrix matrix;
  for (auto& row : matrix.m)
    for (double& number : row) number = random.real(-1, 1) * scale;
  matrix.m[2][3] -= 3 * scale;
  return matrix;
}

// A film with one segment: a meshlet of random vertices that follow 1 to 4 of its bones, neighbours in their list.
class OneSkin {
 public:
  using Float3 = std::array<float, 3>;

  OneSkin(shape::Random& random, std::uint32_t bones, double scale = 1)
      : OneSkin(random, random_bones(random, bones, scale), wire::Blend::linear) {}

  OneSkin(shape::Random& random, const std::vector<wire::Matrix>& matrices, wire::Blend blend) {
    const auto bones = static_cast<std::uint32_t>(matrices.size());
    wire::FilmData film = wire::small_film();
    film.segments.resize(1);
    film.segments[0] = {0, 0, {0, 1}, {0, 1}, 0, 0, bones, blend};
    film.shapes = {{0, static_cast<std::uint32_t>(film.patches.size()), 0, 1, bones}};
    film.net_points.clear(), film.stencil_terms.clear(), film.stencils.clear(), film.net_patches.clear();
    film.intervals = {{0, 3, 0, 0}};
    film.mesh_places.clear(), film.mesh_normals.clear();
    film.skin_bones.clear(), film.bones.clear();
    wire::Meshlet meshlet{0, kVertices, 0, 1, {1, 1, 1}, {0, 0, 0}, {0, bones, 0}};
    for (std::uint32_t v = 0; v < kVertices; ++v) {
      Float3 place, normal;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        place[axis] = static_cast<float>(random.real(0, 1));
        normal[axis] = static_cast<float>(random.real(-1, 1));
        meshlet.low[axis] = std::min(meshlet.low[axis], place[axis]);
        meshlet.high[axis] = std::max(meshlet.high[axis], place[axis]);
      }
      film.mesh_places.push_back(place);
      film.mesh_normals.push_back(normal);
    }
    film.mesh_triangles = {{0, 1, 2}};
    film.meshlets = {meshlet};
    film.skin_weights.clear();
    add_weights(random, kVertices, bones, film.skin_weights);
    for (std::size_t patch = 0; patch < film.patches.size(); ++patch) add_net_patch(random, bones, film);
    for (std::uint32_t bone = 0; bone < bones; ++bone) {
      film.skin_bones.push_back(bone);
      film.bones.push_back({static_cast<std::uint32_t>(film.changes.size()), 1});
      film.changes.push_back({0, static_cast<std::uint32_t>(film.matrices.size())});
      film.matrices.push_back(matrices[bone]);
    }
    block_ = wire::pack(film);
  }

  wire::PackedFilm view() const { return {block_, "film"}; }

 private:
  static std::vector<wire::Matrix> random_bones(shape::Random& random, std::uint32_t bones, double scale) {
    std::vector<wire::Matrix> all;
    for (std::uint32_t bone = 0; bone < bones; ++bone) all.push_back(random_bone(random, scale));
    return all;
  }

  // Of sixteen points of its own: every other is one of them, the others are means of two.
  static void add_net_patch(shape::Random& random, std::uint32_t bones, wire::FilmData& film) {
    wire::NetPatch& patch = film.net_patches.emplace_back(wire::NetPatch{{}, 0, bones});
    const auto first = static_cast<std::uint32_t>(film.net_points.size());
    for (std::uint32_t i = 0; i < wire::kPatchPoints; ++i) {
      wire::NetPoint point{{}, {0, bones, static_cast<std::uint32_t>(film.skin_weights.size())}};
      for (float& coordinate : point.place) coordinate = static_cast<float>(random.real(0, 1));
      film.net_points.push_back(point);
      add_weights(random, 1, bones, film.skin_weights);
      patch.stencils[i] = static_cast<std::uint32_t>(film.stencils.size());
      const auto term = static_cast<std::uint32_t>(film.stencil_terms.size());
      if (i % 2 == 0) {
        film.stencils.push_back({term, 1});
        film.stencil_terms.push_back({first + i, 1});
      } else {
        film.stencils.push_back({term, 2});
        film.stencil_terms.insert(film.stencil_terms.end(), {{first + i - 1, 0.3f}, {first + i, 0.7f}});
      }
    }
  }

  // Bone by bone, of `points` points.
  static void add_weights(shape::Random& random, std::uint32_t points, std::uint32_t bones,
                          std::vector<float>& weights) {
    const std::size_t begin = weights.size();
    weights.resize(begin + std::size_t{points} * bones, 0);
    for (std::uint32_t point = 0; point < points; ++point) {
      const auto count = std::min<std::uint32_t>(bones, static_cast<std::uint32_t>(random.whole(1, 4)));
      std::vector<double> parts;
      double sum = 0;
      for (std::uint32_t i = 0; i < count; ++i) sum += parts.emplace_back(random.real(0.1, 1));
      const auto first = static_cast<std::uint32_t>(random.whole(0, static_cast<std::int32_t>(bones - count)));
      for (std::uint32_t i = 0; i < count; ++i)
        weights[begin + (first + i) * points + point] = static_cast<float>(parts[i] / sum);
    }
  }

  std::vector<std::byte> block_;
};

struct Placed {
  Scene scene;
  SegmentPlace place;

  explicit Placed(const wire::PackedFilm& film) : scene(film) { place.find(scene, 0); }
};

inline std::array<float, 2> range_of(const BoxCorners& corners, int axis) {
  std::array<float, 2> range{corners.point[0][axis], corners.point[0][axis]};
  for (const auto& point : corners.point) {
    range[0] = std::min(range[0], point[axis]);
    range[1] = std::max(range[1], point[axis]);
  }
  return range;
}

// Whether vertices and patches' points, as they are drawn, lie in the boxes round the meshlet and the shape. Returns
// how much wider than the vertices the wider box is along some axis.
inline double expect_within_bounds(const wire::PackedFilm& film, const std::string& where) {
  const Placed placed(film);
  MeshletPlacer placer(simd::best_instruction_set(""));
  placer.place(placed.place, film, film.meshlets()[0], kSeen);
  const BoxCorners of_meshlet = placed.place.corners(film, film.meshlets()[0]),
                   of_shape = placed.place.corners(ShapeBoxes(film));
  double widest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [low, high] = range_of(of_shape, axis);
    for (std::size_t number = 0; number < film.patches().size(); ++number)
      for (const auto& point : placed.place.patch(film, number).point)
        EXPECT_TRUE(low <= point[axis] && point[axis] <= high) << where << ", a patch";
    const float* const places = placer.vertices().place[axis];
    const auto [least, most] = std::minmax_element(places, places + kVertices);
    for (const BoxCorners& corners : {of_meshlet, of_shape}) {
      const auto [from, to] = range_of(corners, axis);
      EXPECT_TRUE(from <= *least && *most <= to) << where;
      widest = std::max(widest, double{to - from} / (*most - *least));
    }
  }
  return widest;
}

}  // namespace mars::geometry
