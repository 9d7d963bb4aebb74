// Orthographic cameras and lens shift: against the plain twin, against each other and formulas, and the same bits
// however the work is divided (as identity_test.cpp has it for other films).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "host/content/modeler/primitives.h"
#include "node/frame_counter.h"
#include "tests/node/simd/instruction_sets.h"
#include "tests/render/film_run.h"
#include "tests/render/films.h"
#include "tests/render/looks.h"
#include "tests/render/reference.h"

namespace mars::test {
namespace {

// Each look of a film that this page is about.
std::vector<wire::FilmData> looks_of(const wire::FilmData& film) {
  return {orthographic(film), shifted(film, 0.3, -0.2), shifted(orthographic(film), -0.4, 0.25)};
}

TEST(Cameras, DrawWhatTheReferenceDraws) {
  for (const wire::FilmData& film : looks_of(crowd(160, 90, 3, 3))) expect_as_reference(film, 2, 3);
  for (const wire::FilmData& film : looks_of(richly_lit(with_samples(crowd(160, 90, 3, 3), 4))))
    expect_as_reference(film, 2, 2);
  for (const wire::FilmData& film : looks_of(with_samples(ties(60, 45), 2))) expect_as_reference(film, 1, 2);
}

TEST(Cameras, DrawWhatTheReferenceDrawsAtTheNearPlane) {
  for (const wire::FilmData& film : looks_of(flight(120, 68, 4))) expect_as_reference(film, 3, 2);
  for (const wire::FilmData& film : looks_of(richly_lit(with_samples(flight(100, 56, 4), 2))))
    expect_as_reference(film, 3, 1);
}

// Frames as of one node without coherence.
void expect_same_bits(const wire::FilmData& film, const std::string& name) {
  const FilmBlock block(film);
  RunOptions from_scratch;
  from_scratch.work.coherence = false;
  from_scratch.simd = "sse2";
  const FilmRun expected = run_film(block.bytes(), from_scratch);
  const auto expect_as_expected = [&](const RunOptions& options, const std::string& how) {
    expect_same(run_film(block.bytes(), options), expected, film.settings, name + "-" + how);
  };
  for (const auto& [nodes, groups, sharers] : {std::array{1, 1, 1}, {3, 1, 1}, {5, 2, 1}, {4, 1, 4}}) {
    RunOptions options;
    options.nodes = nodes;
    options.work.groups = static_cast<std::uint32_t>(groups);
    options.work.sharers = sharers;
    expect_as_expected(options, std::to_string(nodes) + "-nodes");
  }
  for (const simd::InstructionSet set : simd::sets_here()) {
    RunOptions options;
    options.simd = simd::name_of(set);
    expect_as_expected(options, options.simd);
  }
  if (block.view().casting_count() > 0) return;  // shadows have memory of their own
  RunOptions few_lines;
  few_lines.nodes = 2;
  few_lines.memory = 300'000 + 200 * film.settings.height;
  few_lines.farm.asked_memory.still = 0;
  expect_as_expected(few_lines, "short-memory");
}

TEST(Cameras, DrawTheSameBitsHoweverTheWorkIsDivided) {
  int number = 0;
  for (const wire::FilmData& film :
       {crowd(96, 61, 4, 2), richly_lit(with_samples(crowd(60, 34, 4, 4), 4)), flight(60, 34, 3),
        casting(crowd(64, 40, 4, 4), {0.0f, 0.0f}), casting(with_samples(overhead(64, 48, 4, 4), 4), {0.04f, 0.0f})})
    for (const wire::FilmData& look :
         {orthographic(film), shifted(orthographic(film), 0.3, -0.1), shifted(film, 0.2, 0.3)})
      expect_same_bits(look, "cameras-" + std::to_string(number++));
}

// Forecasts count by the nodes' own code.
TEST(Cameras, AreCountedAsTheyAreDrawn) {
  for (const wire::FilmData& film : looks_of(casting(crowd(96, 61, 1, 1), {0.0f, 0.0f}))) {
    const FilmBlock block(film);
    const Pixels pixels = run_film(block.bytes()).frames.at(0);
    const auto drawn = std::ranges::count_if(pixels, [](std::uint32_t pixel) { return pixel != 0xff00ff; });
    node::FrameCounter counter(block.view(), simd::best_instruction_set(""), true);
    const std::uint32_t frames[] = {0};
    double counted = 0, points = 0;
    for (const wire::LineCounts& line : counter.count_keyframe(0, frames).lines) {
      counted += line.constant.pixels;
      points += line.constant.points;
    }
    EXPECT_EQ(counted, static_cast<double>(drawn));
    EXPECT_GT(points, counted / 2) << "of two lights that cast";
  }
}

wire::FilmData ball_at(double distance, std::uint32_t size) {
  FilmMaker maker(size, size, 1);
  maker.add_segment(maker.add_shape(modeler::make_sphere()),
                    maker.add_material({{0.5f, 0.7f, 0.9f}, 0.1f, 0.65f, 0.45f, 20, 2}),
                    {placed({-1, distance - 1, -1}, 2)});
  maker.add_light({wire::LightKind::directional, {-0.48f, -0.6f, 0.64f}, {1, 1, 1}});
  wire::Camera camera = looking({0, 0, 0}, {0, 1, 0}, 30);
  camera.projection = wire::Projection::orthographic;
  camera.focal = 2 / 2.5;  // the picture is 2.5 high
  maker.set_cameras({camera});
  return maker.make();
}

// A ball of radius 1 is a disc of radius 1, lit as parallel rays find it, however far away it is.
TEST(Orthographic, BallFollowsTheFormula) {
  constexpr std::uint32_t kSize = 300, kBackground = 0xff00ff;
  for (const double distance : {1.5, 8.0, 300.0}) {
    const Pixels pixels = run_film(FilmBlock(ball_at(distance, kSize)).bytes()).frames.at(0);
    const double light[] = {-0.48, 0.64, 0.6};  // in eye space
    double worst = 0;
    int counted = 0;
    for (std::uint32_t row = 0; row < kSize; ++row)
      for (std::uint32_t column = 0; column < kSize; ++column) {
        const double x = (column + 0.5 - kSize / 2.0) * 2.5 / kSize, y = (kSize / 2.0 - row - 0.5) * 2.5 / kSize;
        const double inside = (1 - std::hypot(x, y)) * kSize / 2.5;  // pixels
        const std::uint32_t pixel = pixels[row * kSize + column];
        EXPECT_TRUE(std::abs(inside) < 0.3 || (pixel != kBackground) == (inside > 0)) << column << ", " << row;
        if (inside < 1) continue;
        const double z = std::sqrt(1 - x * x - y * y);
        const double facing = std::max(0.0, light[0] * x + light[1] * y + light[2] * z);
        const double mirrored = facing > 0 ? 2 * facing * z - light[2] : 0;
        const double highlight = std::pow(std::max(0.0, mirrored), 20);
        const double expected = 255 * std::min(1.0, 0.1 * 0.7 + 0.65 * 0.7 * facing + 0.45 * highlight);
        worst = std::max(worst, std::abs(expected - static_cast<double>(pixel >> 8 & 255)));
        ++counted;
      }
    EXPECT_GT(counted, 40000);
    EXPECT_LT(worst, 4) << "levels of 255, at distance " << distance;
  }
}

// A picture that is shifted by half its width to the right is the right half of one that is twice as wide.
TEST(LensShift, ShowsAnotherPartOfTheSamePicture) {
  constexpr std::uint32_t kWidth = 100, kHeight = 90;
  for (const bool parallel : {false, true}) {
    const auto drawn = [&](std::uint32_t width, double right) {
      const wire::FilmData film = shifted(crowd(width, kHeight, 1, 1), right, 0);
      return run_film(FilmBlock(parallel ? orthographic(film) : film).bytes()).frames.at(0);
    };
    const Pixels whole = drawn(2 * kWidth, 0), right = drawn(kWidth, 0.5), left = drawn(kWidth, -0.5);
    std::size_t others = 0;
    for (std::uint32_t row = 0; row < kHeight; ++row)
      for (std::uint32_t column = 0; column < kWidth; ++column) {
        others += whole[row * 2 * kWidth + kWidth + column] != right[row * kWidth + column];
        others += whole[row * 2 * kWidth + column] != left[row * kWidth + column];
      }
    EXPECT_LT(others, 2 * kWidth * kHeight / 500);  // where a place is snapped the other way
  }
}

TEST(LensShift, UpShowsWhatIsAbove) {
  constexpr std::uint32_t kSide = 60;
  const auto drawn = [](std::uint32_t height, double up) {
    wire::FilmData film = shifted(crowd(kSide, height, 1, 1), 0, up);
    film.cameras.front().focal *= static_cast<double>(kSide) / height;
    return run_film(FilmBlock(film).bytes()).frames.at(0);
  };
  const Pixels whole = drawn(2 * kSide, 0), above = drawn(kSide, 0.5);
  std::size_t others = 0;
  for (std::size_t k = 0; k < above.size(); ++k) others += whole[k] != above[k];
  EXPECT_LT(others, above.size() / 500);
}

}  // namespace
}  // namespace mars::test
