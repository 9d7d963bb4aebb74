// Promise 3: nothing drawn that is outside, whatever is in front of, behind, round or far from the eye, on
// pictures of any size.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "host/content/modeler/primitives.h"
#include "tests/render/film_run.h"
#include "tests/render/films.h"
#include "tests/render/looks.h"

namespace mars::test {
namespace {

constexpr std::uint32_t kBackground = 0xff00ff;

struct Body {
  std::vector<wire::Patch> patches;
  wire::Matrix matrix;
};

wire::FilmData scene(std::uint32_t width, std::uint32_t height, const std::vector<Body>& bodies,
                     const wire::Camera& camera) {
  FilmMaker maker(width, height, 1);
  const std::uint32_t material = maker.add_material(kClay);
  for (const Body& body : bodies) maker.add_segment(maker.add_shape(body.patches), material, {body.matrix});
  maker.add_light({wire::LightKind::directional, {0, -0.6f, 0.8f}, {1, 1, 1}});
  maker.set_cameras({camera});
  return maker.make();
}

wire::Matrix centred(const Vec3& middle, double size) {
  return placed({middle[0] - size / 2, middle[1] - size / 2, middle[2] - size / 2}, size);
}

FilmRun draw(const wire::FilmData& film, int nodes) {
  RunOptions options;
  options.nodes = nodes;
  return run_film(FilmBlock(film).bytes(), options);
}

double covered(const wire::FilmData& film, int nodes = 2) {
  const Pixels pixels = draw(film, nodes).frames.at(0);
  const auto shown = pixels.size() - static_cast<std::size_t>(std::count(pixels.begin(), pixels.end(), kBackground));
  return static_cast<double>(shown) / static_cast<double>(pixels.size());
}

const wire::Camera kAhead = looking({0, 0, 0}, {0, 10, 0}, 40);

TEST(Extremes, WhatIsBehindTheEyeIsNotSeen) {
  EXPECT_EQ(covered(scene(200, 100, {{modeler::make_sphere(), centred({0, -5, 0}, 4)}}, kAhead)), 0);
  EXPECT_EQ(covered(scene(200, 100, {{modeler::make_box(), centred({0, -5, 0}, 9.9)}}, kAhead)), 0);
}

TEST(Extremes, FromWithinABodyItIsAllRound) {
  for (const auto& patches : {modeler::make_sphere(), modeler::make_box(), modeler::make_cylinder()})
    for (const Vec3& at : {Vec3{0, 10, 0}, Vec3{10, 0, 3}, Vec3{-1, -4, 10}})
      EXPECT_EQ(covered(scene(160, 90, {{patches, centred({0.1, 0.2, -0.1}, 6)}}, looking({0, 0, 0}, at, 100, 0.01))),
                1);
}

TEST(Extremes, NearAndFarCut) {
  wire::Camera camera = kAhead;
  camera.near = 6;
  EXPECT_EQ(covered(scene(100, 100, {{modeler::make_box(), centred({0, 3, 0}, 4)}}, camera)), 0) << "nearer than near";
  camera = kAhead;
  camera.far = 20;
  EXPECT_EQ(covered(scene(100, 100, {{modeler::make_box(), centred({0, 30, 0}, 9)}}, camera)), 0) << "farther than far";
  // A long bar through both: seen between them only.
  camera.near = 5;
  EXPECT_GT(covered(scene(100, 100, {{modeler::make_box(), centred({0, 0, -20}, 39.5)}}, camera)), 0);
}

TEST(Extremes, APatchFarLargerThanTheScreenCoversHalfOfIt) {
  const auto ground = scene(320, 240, {{modeler::make_box(), centred({0, 0, -1e5 - 1}, 2e5)}},
                            looking({0, 0, 0}, {0, 10, 0}, 40, 0.1, 1e9));
  EXPECT_NEAR(covered(ground), 0.5, 0.01);
}

TEST(Extremes, ScaleChangesNothingToSpeakOf) {
  const auto at_scale = [](double s) {
    return covered(scene(300, 300, {{modeler::make_sphere(), centred({0, 8 * s, 0}, 4 * s)}},
                         looking({0, 0, 0}, {0, s, 0}, 40, s * 0.01, s * 1000)));
  };
  const double normal = at_scale(1);
  EXPECT_NEAR(normal, 3.14159 * std::pow(2 / std::sqrt(60.0) / (2 * std::tan(0.349066)), 2), 0.002);
  for (const double s : {1e-4, 1e-2, 1e3, 1e7}) EXPECT_NEAR(at_scale(s), normal, 0.0005) << s;
}

TEST(Extremes, PatchesFarSmallerThanAPixel) {
  std::vector<Body> dust;
  for (int i = 0; i < 400; ++i)
    dust.push_back({modeler::make_sphere(), centred({(i % 20 - 9.5) * 0.02, 10, (i / 20 - 9.5) * 0.02}, 0.03)});
  const double shown = covered(scene(64, 64, dust, kAhead));
  EXPECT_GT(shown, 0.001);
  EXPECT_LT(shown, 0.01);
}

TEST(Extremes, TheLargestCommonPicture) {
  const double large = covered(scene(7680, 4320, {{modeler::make_torus(0.2), centred({0, 8, 0}, 5)}}, kAhead));
  const double small = covered(scene(768, 432, {{modeler::make_torus(0.2), centred({0, 8, 0}, 5)}}, kAhead));
  EXPECT_NEAR(large, small, 0.002);
}

// A line of such a picture has 16 sub-scanlines: 262144 of them do not count in 16 bits.
TEST(Extremes, ManySamplesOfThinHighAndLargePictures) {
  const auto torus = [](std::uint32_t width, std::uint32_t height) {
    return scene(width, height, {{modeler::make_torus(0.2), centred({0, 8, 0}, 5)}}, kAhead);
  };
  EXPECT_NEAR(covered(with_samples(torus(7680, 4320), 16)), covered(torus(768, 432)), 0.002);
  EXPECT_EQ(covered(with_samples(scene(1, 1, {{modeler::make_box(), centred({0, 12, 0}, 9)}}, kAhead), 16)), 1);
  EXPECT_EQ(covered(with_samples(scene(1, 1, {}, kAhead), 16)), 0);
}

// The front of a box is the middle half of the lines; before its lower quarter another one moves.
TEST(Extremes, ManySamplesOfMostLines) {
  constexpr std::uint32_t kLines = 16384;
  FilmMaker maker(8, kLines, 2);
  const std::uint32_t box = maker.add_shape(modeler::make_box());
  maker.add_segment(box, maker.add_material({{1, 0, 0}, 1, 0, 0, 1, 2}), {centred({0, 12, 0}, 4)});
  const wire::Matrix mover = centred({0, 9, -1.5}, 1);
  maker.add_segment(box, maker.add_material({{0, 1, 0}, 1, 0, 0, 1, 2}), {mover, placed({-0.501, 8.5, -2}, 1)});
  wire::Camera camera = kAhead;
  camera.focal = 2.5;
  maker.set_cameras({camera});
  const FilmRun run = draw(with_samples(maker.make(), 16), 3);
  for (const auto& [frame, pixels] : run.frames)
    for (const auto& [row, shown] : {std::pair{4095u, kBackground},
                                     {4096u, 0xffu},
                                     {8192u, 0xffu},
                                     {10600u, 0xff00u},
                                     {12287u, 0xff00u},
                                     {13009u, 0xff00u},
                                     {13012u, kBackground}})
      for (std::uint32_t column = 0; column < 8; ++column)
        EXPECT_EQ(pixels[8 * row + column], shown) << "line " << row << ", frame " << frame;
}

TEST(Extremes, VeryWideAndVeryHighPictures) {
  EXPECT_GT(covered(scene(16384, 3, {{modeler::make_sphere(), centred({0, 8, 0}, 5)}}, kAhead)), 0);
  EXPECT_GT(covered(scene(2, 16384, {{modeler::make_sphere(), centred({0, 8, 0}, 5)}}, kAhead)), 0);
}

}  // namespace
}  // namespace mars::test
