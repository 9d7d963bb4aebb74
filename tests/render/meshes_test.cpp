// Polygon meshes in whole frames: the same picture as patches diced to the same triangles, closed ones without a hole.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "host/content/modeler/primitives.h"
#include "node/shape/dice.h"
#include "node/simd/instruction_set.h"
#include "tests/render/film_run.h"
#include "tests/render/films.h"

namespace mars::test {
namespace {

constexpr std::uint32_t kWidth = 320, kHeight = 240, kBackground = 0xff00ff;
constexpr int kRate = 6;

const wire::Matrix kAsItIs{{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}}};

wire::Camera at_origin() { return {kAsItIs, 2.5, 0.1, 100}; }

Pixels draw(FilmMaker& maker, int nodes = 2) {
  maker.add_light({wire::LightKind::directional, {0.4f, 0.3f, 0.866f}, {1, 1, 1}});
  maker.set_cameras({at_origin()});
  RunOptions options;
  options.nodes = nodes;
  return run_film(FilmBlock(maker.make()).bytes(), options).frames.at(0);
}

// Each patch's dicing in eye space as a meshlet, which an eye at the origin leaves where it is.
modeler::Meshlets diced(const std::vector<wire::Patch>& patches, const wire::Matrix& matrix) {
  modeler::Meshlets out;
  shape::Dicer dicer(simd::best_instruction_set(""));
  const shape::Projection projection{300, {160, 120}, 0.1f, 100, 32768, 0.8f};
  for (const wire::Patch& patch : patches) {
    dicer.dice(shape::to_eye(shape::eye_matrix(kAsItIs, matrix), patch), projection,
               {.fixed_rate = kRate, .tolerances = {}});
    const shape::Vertices& v = dicer.vertices();
    const auto count = static_cast<std::uint32_t>(dicer.vertex_count());
    wire::Meshlet meshlet{static_cast<std::uint32_t>(out.places.size()),
                          count,
                          static_cast<std::uint32_t>(out.triangles.size()),
                          dicer.triangles().count,
                          {100, 100, 100},
                          {-100, -100, -100}};
    for (std::uint32_t k = 0; k < count; ++k) {
      out.places.push_back({v.place[0][k], v.place[1][k], v.place[2][k]});
      out.normals.push_back({v.normal[0][k], v.normal[1][k], v.normal[2][k]});
      for (std::size_t axis = 0; axis < 3; ++axis) {
        meshlet.low[axis] = std::min(meshlet.low[axis], out.places.back()[axis]);
        meshlet.high[axis] = std::max(meshlet.high[axis], out.places.back()[axis]);
      }
    }
    for (std::uint32_t k = 0; k < dicer.triangles().count; ++k) {
      const shape::Corner3 t = dicer.triangles()[k];
      out.triangles.push_back(
          {static_cast<std::uint8_t>(t.a), static_cast<std::uint8_t>(t.b), static_cast<std::uint8_t>(t.c)});
    }
    out.meshlets.push_back(meshlet);
  }
  return out;
}

int difference(std::uint32_t a, std::uint32_t b) {
  int most = 0;
  for (int shift = 0; shift < 24; shift += 8)
    most = std::max(most, std::abs(static_cast<int>(a >> shift & 255) - static_cast<int>(b >> shift & 255)));
  return most;
}

// Places are the same bits, so the same samples show the same triangles; only normals, which meshes normalise once
// more, may round otherwise.
TEST(Meshes, ADicedSphereIsThePatchesSphere) {
  const auto sphere = modeler::make_sphere();
  for (const wire::Matrix& matrix :
       {placed({-0.9, -1, -6}, 2, 0.3), placed({-8, -8, -17}, 16), placed({0.5, 0.2, -3}, 0.1)}) {
    FilmMaker patches(kWidth, kHeight, 1), mesh(kWidth, kHeight, 1);
    patches.film.settings.dice = kRate;
    patches.add_segment(patches.add_shape(sphere), patches.add_material(kClay), {matrix});
    mesh.add_segment(mesh.add_shape(diced(sphere, matrix)), mesh.add_material(kClay), {kAsItIs});
    const Pixels expected = draw(patches), found = draw(mesh, 3);
    int shown = 0, other = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      ASSERT_EQ(expected[i] == kBackground, found[i] == kBackground) << "pixel " << i;
      ASSERT_LE(difference(expected[i], found[i]), 1) << "pixel " << i;
      shown += expected[i] != kBackground;
      other += expected[i] != found[i];
    }
    EXPECT_GT(shown, 50);
    EXPECT_LE(other, shown / 50);
  }
}

// From outside nothing of a closed body's inside is seen, so leaving it away changes no pixel: a crack would show it,
// or the background.
TEST(Meshes, AClosedBodyHasNoHole) {
  for (const std::uint32_t rows : {1u, 7u, 60u, 200u})
    for (const double size : {0.02, 0.7, 3.0, 5.4}) {
      Pixels pixels[2];
      for (const std::uint32_t sides : {1u, 2u}) {
        FilmMaker maker(kWidth, kHeight, 1);
        wire::Material material = kClay;
        material.sides = sides;
        wire::Matrix matrix = placed({-0.4 * size, -0.6 * size, -6}, size, 0.7);
        matrix.m[0][2] = 0.35 * size;  // sheared
        maker.add_segment(maker.add_shape(modeler::cut_meshlets(mesh_ball(rows, rows % 2 == 1 ? 0 : 180))),
                          maker.add_material(material), {matrix});
        pixels[sides - 1] = draw(maker);
      }
      EXPECT_EQ(pixels[0], pixels[1]) << rows << " rows, size " << size;
      // Seen as a convex body: each line shows one run of it.
      for (std::uint32_t row = 0; row < kHeight; ++row) {
        const auto begin = pixels[0].begin() + row * kWidth, end = begin + kWidth;
        const auto shows = [](std::uint32_t pixel) { return pixel != kBackground; };
        const auto first = std::find_if(begin, end, shows);
        const auto after = std::find_if_not(first, end, shows);
        EXPECT_EQ(std::find_if(after, end, shows), end) << "a hole in line " << row;
      }
    }
}

// Nothing is lost where the near plane or the guard band cuts through a mesh: from within it is all round.
TEST(Meshes, FromWithinABodyItIsAllRound) {
  for (const double size : {0.5, 6.0, 3e4}) {
    FilmMaker maker(kWidth, kHeight, 1);
    wire::Matrix matrix = placed({-0.55 * size, -0.48 * size, -0.6 * size}, size, 0.1);
    maker.add_segment(maker.add_shape(modeler::cut_meshlets(mesh_ball(9, 30))), maker.add_material(kClay), {matrix});
    maker.add_light({wire::LightKind::directional, {0, 0, 1}, {1, 1, 1}});
    wire::Camera camera = at_origin();
    camera.near = 0.01;
    camera.far = 1e9;
    maker.set_cameras({camera});
    RunOptions options;
    options.nodes = 2;
    const Pixels pixels = run_film(FilmBlock(maker.make()).bytes(), options).frames.at(0);
    EXPECT_EQ(std::count(pixels.begin(), pixels.end(), kBackground), 0) << size;
  }
}

}  // namespace
}  // namespace mars::test
