// Meshes with skins in whole frames: the same bits however the work is divided, as from scratch, and as the plain twin
// of the renderer draws them; a skin holds still until one of its bones moves.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>
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

constexpr wire::Blend kBlends[] = {wire::Blend::linear, wire::Blend::dual_quaternions};

wire::FilmData small_bending(wire::Blend blend) { return bending(120, 80, 5, 3, blend); }

std::string name_of(wire::Blend blend) { return blend == wire::Blend::linear ? "linear" : "dual"; }

FilmRun from_scratch(const wire::FilmData& film, wire::PixelFormat format = wire::PixelFormat::rgb8) {
  RunOptions options;
  options.work.coherence = false;
  options.simd = "sse2";
  options.format = format;
  return run_film(FilmBlock(film).bytes(), options);
}

TEST(Skins, AreTheSameBitsHoweverTheWorkIsDivided) {
  for (const auto& [samples, blend] :
       {std::pair{1u, kBlends[0]}, {4u, kBlends[0]}, {1u, kBlends[1]}, {4u, kBlends[1]}}) {
    const wire::FilmData film = with_samples(small_bending(blend), samples);
    const FilmRun expected = from_scratch(film);
    for (const auto& [nodes, groups, sharers] : {std::tuple{1, 1u, 1}, {3, 1u, 1}, {5, 2u, 2}, {4, 1u, 4}}) {
      RunOptions options;
      options.nodes = nodes;
      options.work.groups = groups;
      options.work.sharers = sharers;
      expect_same(run_film(FilmBlock(film).bytes(), options), expected, film.settings,
                  name_of(blend) + "-skins-" + std::to_string(samples) + "-samples-" + std::to_string(nodes) +
                      "-nodes");
    }
  }
}

TEST(Skins, AreTheSameBitsFromEveryInstructionSet) {
  for (const wire::Blend blend : kBlends) {
    const wire::FilmData film = small_bending(blend);
    const FilmRun expected = from_scratch(film);
    for (const simd::InstructionSet set : simd::all_sets()) {
      RunOptions options;
      options.simd = simd::name_of(set);
      options.nodes = 2;
      expect_same(run_film(FilmBlock(film).bytes(), options), expected, film.settings,
                  name_of(blend) + "-skins-" + options.simd);
    }
  }
}

TEST(Skins, LookOtherwiseByDualQuaternions) {
  EXPECT_NE(from_scratch(small_bending(kBlends[0])).frames, from_scratch(small_bending(kBlends[1])).frames);
}

// The twin draws no shadows.
TEST(Skins, AreDrawnAsByThePlainTwin) {
  for (const wire::Blend blend : kBlends) {
    wire::FilmData film = small_bending(blend);
    for (wire::Light& light : film.lights) light.casts = 0;
    for (const std::uint32_t frame : {0u, 4u}) expect_as_reference(film, frame, 3);
  }
}

// The same film, elsewhere in the world.
wire::FilmData far_away(wire::FilmData film) {
  constexpr double kFar[] = {1e7, -2e7, 0};
  for (wire::Matrix& matrix : film.matrices)
    for (int r = 0; r < 3; ++r) matrix.m[r][3] += kFar[r];
  for (wire::Camera& camera : film.cameras)
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) camera.world_to_eye.m[r][3] -= camera.world_to_eye.m[r][c] * kFar[c];
  for (wire::Light& light : film.lights)
    for (std::size_t axis = 0; axis < 3 && light.kind != wire::LightKind::directional; ++axis)
      light.vector[axis] += kFar[axis];
  return film;
}

// Where sums of weights are not quite 1, bones move points by a part of the way to the origin of the space in which
// they are blended: that of a sweep is the nodes'.
TEST(Skins, AreTheSameBitsFarFromTheWorldsOrigin) {
  for (const wire::Blend blend : kBlends) {
    const wire::FilmData film = far_away(small_bending(blend));
    expect_same(run_film(FilmBlock(film).bytes(), {}), from_scratch(film), film.settings, name_of(blend) + "-far");
  }
}

// The lowest bones of each tube stand still, and all of one tube.
TEST(Skins, HoldStillUntilABoneMoves) {
  const wire::FilmData film = bending(64, 40, 4, 4);
  ASSERT_EQ(film.intervals.size(), 1u);
  std::vector<std::uint32_t> moving = {2, 4, 5};
  for (const auto& [segment, standing] : {std::pair{2u, 1u}, {4u, 18u}, {5u, 3u}})
    for (std::uint32_t bone = standing; bone < film.segments[segment].bone_count; ++bone)
      moving.push_back(static_cast<std::uint32_t>(film.segments.size()) + film.segments[segment].first_bone + bone);
  EXPECT_EQ(film.moving, moving);
  const FilmBlock block(film);
  const wire::PackedFilm view = block.view();
  geometry::Scene scene(view);
  scene.set_interval(0);
  EXPECT_TRUE(scene.moves(2) && !scene.stands(2)) << "no piece follows the lowest bone alone";
  for (const std::uint32_t segment : {4u, 5u}) {
    const auto size = view.shape(film.segments[segment].shape).size();
    std::uint64_t moving_pieces = 0;
    for (std::size_t piece = 0; piece < size; ++piece) moving_pieces += scene.moves(segment, piece);
    EXPECT_TRUE(scene.moves(segment) && scene.stands(segment));
    EXPECT_GT(moving_pieces, 0u) << segment;
    EXPECT_LT(moving_pieces, size) << segment;
  }
}

// A film of one interval in which of the tube with many bones one alone moves, once, as `move` changes its matrix.
template <typename Move>
wire::FilmData with_one_moving_bone(std::uint32_t moving_bone, const Move& move) {
  wire::FilmData film = with_samples(bending(120, 80, 3, 3), 4);
  const wire::Segment& tube = film.segments[4];
  for (std::uint32_t bone = 0; bone < tube.bone_count; ++bone) film.bones[tube.first_bone + bone].count = 1;
  wire::Track& track = film.bones[tube.first_bone + moving_bone];
  const std::uint32_t value = film.changes[track.first].value;
  track = {static_cast<std::uint32_t>(film.changes.size()), 2};
  film.changes.insert(film.changes.end(), {{0, value}, {1, static_cast<std::uint32_t>(film.matrices.size())}});
  film.matrices.push_back(film.matrices[value]);
  move(film.matrices.back());
  const auto first = static_cast<std::uint32_t>(film.segments.size()) + tube.first_bone;
  std::erase_if(film.moving, [&](std::uint32_t part) { return part >= first && part < first + tube.bone_count; });
  film.moving.insert(std::ranges::lower_bound(film.moving, first), first + moving_bone);
  film.intervals[0].moving_count = static_cast<std::uint32_t>(film.moving.size());
  return film;
}

// The lowest bone of a tube that is seen from outside only turns inside out; what follows others alone stays as it was
// drawn in the keyframe.
TEST(Skins, PiecesTurnInsideOutWithTheirOwnBones) {
  const wire::FilmData film = with_one_moving_bone(0, [](wire::Matrix& matrix) {
    for (auto& row : matrix.m) row[3] += row[0], row[0] = -row[0];
  });
  ASSERT_EQ(film.materials[film.changes[film.segments[4].material.first].value].sides, 1u);
  expect_same(run_film(FilmBlock(film).bytes(), {}), from_scratch(film), film.settings, "skins-inside-out");
}

// So far from the eye that the others' normals would be lost beside it.
TEST(Skins, PiecesKeepTheirNormalsHoweverFarOtherBonesStretch) {
  const wire::FilmData film = with_one_moving_bone(23, [](wire::Matrix& matrix) {
    for (auto& row : matrix.m) row[1] *= 8e11;
  });
  expect_same(run_film(FilmBlock(film).bytes(), {}), from_scratch(film), film.settings, "skins-stretched");
}

// A studio's view: an inbetween in which one bone stands elsewhere is the picture of the scene with that bone there.
void expect_bent_in_live_views(wire::Blend blend) {
  wire::FilmData film = bending(96, 64, 1, 1, blend);
  const std::uint32_t bone = film.segments[2].first_bone + 3;
  const auto moved = static_cast<std::uint32_t>(film.segments.size()) + bone;
  film.moving = {2, moved};
  film.intervals = {{0, 1, 0, 2}};
  wire::FilmData scene = film, bent = film;
  scene.patches.clear(), scene.shapes.clear(), scene.meshlets.clear(), scene.mesh_places.clear();
  scene.mesh_normals.clear(), scene.mesh_triangles.clear(), scene.skin_bones.clear(), scene.skin_weights.clear();
  scene.net_points.clear(), scene.stencil_terms.clear(), scene.stencils.clear(), scene.net_patches.clear();
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
        inbetween.frames[0] = host.finish(host.draw(0, {{{moved, 0, elsewhere}}, {}}, 1)).pixels;
      },
      [] {
        node::run_node({"test", "", {}, 64 << 20, ""});
      });
  expect_same(keyframe, from_scratch(film), film.settings, "skins-live-keyframe");
  expect_same(inbetween, from_scratch(bent), film.settings, "skins-live-inbetween");
  EXPECT_NE(keyframe.frames[0], inbetween.frames[0]);
}

TEST(Skins, BendInLiveViews) {
  for (const wire::Blend blend : kBlends) expect_bent_in_live_views(blend);
}

// Every vertex of a moving skin is where the sweep says that something may change.
void expect_swept(wire::Blend blend) {
  const std::uint32_t frames = 6;
  const FilmBlock block(bending(200, 150, frames, frames, blend));
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
      std::size_t piece = film.shape(film.segments()[segment].shape).patch_count;
      for (const wire::Meshlet& meshlet : film.meshlets_of(film.segments()[segment].shape)) {
        if (!scene.moves(segment, piece++)) continue;
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
  // Boxes of dual quaternions are wider, by the arcs of long pieces (dual_skins_test.cpp measures them).
  if (blend == wire::Blend::linear) EXPECT_GT(std::count(covered.begin(), covered.end(), 0), 200 * 150 / 4);
}

TEST(Skins, AreSwept) {
  for (const wire::Blend blend : kBlends) expect_swept(blend);
}

}  // namespace
}  // namespace mars::test
