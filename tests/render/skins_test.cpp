// Meshes with skins in whole frames: the same bits however the work is divided, as from scratch, and as the plain twin
// of the renderer draws them; a skin holds still until one of its bones moves.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <tuple>
#include <vector>

#include "hal/threads/run_threads.h"
#include "node/firmware.h"
#include "node/geometry/meshlets.h"
#include "node/geometry/sweep.h"
#include "node/simd/instruction_set.h"
#include "tests/node/simd/instruction_sets.h"
#include "tests/render/film_run.h"
#include "tests/render/films.h"
#include "tests/render/live_host.h"
#include "tests/render/looks.h"
#include "tests/render/reference.h"

namespace mars::test {
namespace {

wire::FilmData small_bending() { return bending(120, 80, 5, 3); }

FilmRun from_scratch(const wire::FilmData& film, wire::PixelFormat format = wire::PixelFormat::rgb8) {
  RunOptions options;
  options.work.coherence = false;
  options.simd = "sse2";
  options.format = format;
  return run_film(FilmBlock(film).bytes(), options);
}

TEST(Skins, AreTheSameBitsHoweverTheWorkIsDivided) {
  for (const std::uint32_t samples : {1u, 4u}) {
    const wire::FilmData film = with_samples(small_bending(), samples);
    const FilmRun expected = from_scratch(film);
    for (const auto& [nodes, groups, sharers] : {std::tuple{1, 1u, 1}, {3, 1u, 1}, {5, 2u, 2}, {4, 1u, 4}}) {
      RunOptions options;
      options.nodes = nodes;
      options.work.groups = groups;
      options.work.sharers = sharers;
      expect_same(run_film(FilmBlock(film).bytes(), options), expected, film.settings,
                  "skins-" + std::to_string(samples) + "-samples-" + std::to_string(nodes) + "-nodes");
    }
  }
}

TEST(Skins, AreTheSameBitsFromEveryInstructionSet) {
  const wire::FilmData film = small_bending();
  const FilmRun expected = from_scratch(film);
  for (const simd::InstructionSet set : simd::all_sets()) {
    RunOptions options;
    options.simd = simd::name_of(set);
    options.nodes = 2;
    expect_same(run_film(FilmBlock(film).bytes(), options), expected, film.settings, "skins-" + options.simd);
  }
}

// The twin draws no shadows.
TEST(Skins, AreDrawnAsByThePlainTwin) {
  wire::FilmData film = small_bending();
  for (wire::Light& light : film.lights) light.casts = 0;
  for (const std::uint32_t frame : {0u, 4u}) expect_as_reference(film, frame, 3);
}

TEST(Skins, HoldStillUntilABoneMoves) {
  const wire::FilmData film = bending(64, 40, 4, 4);
  ASSERT_EQ(film.intervals.size(), 1u);
  EXPECT_EQ(film.moving, (std::vector<std::uint32_t>{2, 4, 5}));
}

// A studio's view: an inbetween in which one bone stands elsewhere is the picture of the scene with that bone there.
TEST(Skins, BendInLiveViews) {
  wire::FilmData film = bending(96, 64, 1, 1);
  film.moving = {2};
  film.intervals = {{0, 1, 0, 1}};
  wire::FilmData scene = film, bent = film;
  scene.patches.clear(), scene.shapes.clear(), scene.meshlets.clear(), scene.mesh_places.clear();
  scene.mesh_normals.clear(), scene.mesh_triangles.clear(), scene.skin_bones.clear(), scene.skin_weights.clear();
  scene.net_points.clear(), scene.stencil_terms.clear(), scene.stencils.clear(), scene.net_patches.clear();
  const std::uint32_t bone = film.segments[2].first_bone + 3;
  std::uint32_t& value = bent.changes[bent.bones[bone].first].value;
  wire::Matrix elsewhere = bent.matrices[value];
  elsewhere.m[0][3] += 0.4;
  value = static_cast<std::uint32_t>(bent.matrices.size());
  bent.matrices.push_back(elsewhere);
  FilmRun keyframe, inbetween;
  threads::run_threads(
      2,
      [&] {
        LiveHost host;
        host.load(film);
        keyframe.frames[0] = host.finish(host.begin(0, scene)).pixels;
        const auto moved = static_cast<std::uint32_t>(film.segments.size()) + bone;
        inbetween.frames[0] = host.finish(host.draw(0, {{{moved, 0, elsewhere}}, {}}, 1)).pixels;
      },
      [] {
        node::run_node({"test", "", {}, 64 << 20, ""});
      });
  expect_same(keyframe, from_scratch(film), film.settings, "skins-live-keyframe");
  expect_same(inbetween, from_scratch(bent), film.settings, "skins-live-inbetween");
  EXPECT_NE(keyframe.frames[0], inbetween.frames[0]);
}

// Every vertex of a moving skin is where the sweep says that something may change.
TEST(Skins, AreSwept) {
  const std::uint32_t frames = 6;
  const FilmBlock block(bending(200, 150, frames, frames));
  const wire::PackedFilm film = block.view();
  geometry::Scene scene(film);
  scene.set_interval(0);
  std::vector<std::uint32_t> all(frames);
  std::iota(all.begin(), all.end(), 0u);
  std::vector<std::uint8_t> covered(200 * 150);
  geometry::Sweep sweep;
  sweep.begin(scene, all, geometry::ShapeBoxes(film), [&](const geometry::PictureBounds& bounds) {
    for (std::uint32_t y = bounds.lines.first; y < bounds.lines.last; ++y)
      for (std::uint32_t x = bounds.columns.first; x < bounds.columns.last; ++x) covered[y * 200 + x] = 1;
  });
  geometry::MeshletPlacer placer(simd::best_instruction_set(""));
  geometry::SegmentPlace place;
  std::size_t seen = 0;
  for (std::uint32_t frame = 0; frame < frames; ++frame) {
    scene.set_frame(frame);
    for (const std::uint32_t segment : scene.movers()) {
      place.find(scene, segment);
      for (const wire::Meshlet& meshlet : film.meshlets_of(film.segments()[segment].shape)) {
        placer.place(place, film, meshlet, scene.projection());
        for (int v = 0; v < placer.vertex_count(); ++v) {
          const std::int32_t x = placer.vertices().x[v] / 256, y = placer.vertices().y[v] / 256;
          if (x < 0 || x >= 200 || y < 0 || y >= 150) continue;
          ++seen;
          EXPECT_EQ(covered[static_cast<std::size_t>(y * 200 + x)], 1) << "frame " << frame;
        }
      }
    }
  }
  EXPECT_GT(seen, 1000u);
  EXPECT_GT(std::count(covered.begin(), covered.end(), 0), 200 * 150 / 4);
}

}  // namespace
}  // namespace mars::test
