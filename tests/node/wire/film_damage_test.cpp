// Damaged films: whatever PackedFilm is given, it says no or can be read everywhere without harm.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <vector>

#include "hal/failure/failure.h"
#include "node/geometry/meshlets.h"
#include "node/geometry/scene.h"
#include "node/geometry/sweep.h"
#include "node/simd/instruction_set.h"
#include "node/wire/film.h"
#include "tests/node/shape/patches.h"
#include "tests/node/wire/small_film.h"

namespace mars::wire {
namespace {

using Block = std::vector<std::byte>;

// Reads all there is, as nodes do.
std::uint64_t walk(const PackedFilm& film) {
  std::uint64_t sum = film.patch_instances();
  const std::uint32_t last = film.settings().frames - 1;
  geometry::Scene scene(film);
  static geometry::MeshletPlacer placer(simd::best_instruction_set(""));
  for (std::uint32_t i = 0; i < film.intervals().size(); ++i) {
    scene.set_interval(i);
    for (const std::uint32_t frame : {film.intervals()[i].first_frame, last}) {
      scene.set_frame(frame);
      geometry::Sweep sweep;
      sweep.begin(scene, {&frame, 1}, geometry::ShapeBoxes(film),
                  [&](const geometry::PictureBounds& bounds) { sum += bounds.columns.last; });
      sum += sweep.lines().last;
      for (std::size_t s = 0; s < film.segments().size(); ++s) sum += scene.material(s) + scene.first_patch(s);
    }
  }
  geometry::SegmentPlace place;
  const geometry::ShapeBoxes boxes(film);
  for (const Segment& segment : film.segments()) {
    place.find(scene, static_cast<std::size_t>(&segment - film.segments().data()));
    if (film.shape(segment.shape).size() > 0) sum += place.corners(boxes).point[0][0] > 0;
    sum += film.name(segment).size() + static_cast<std::uint64_t>(film.material_at(segment, last).sides);
    const Shape& shape = film.shapes()[segment.shape];
    for (const Patch& patch : film.patches().subspan(shape.first_patch, shape.patch_count))
      sum += patch.points[15][2] > 0;
    for (const Meshlet& meshlet : film.meshlets().subspan(shape.first_meshlet, shape.meshlet_count)) {
      sum += place.corners(film, meshlet).point[0][0] > 0;
      placer.place(place, film, meshlet, scene.projection());
      sum += static_cast<std::uint64_t>(placer.vertex_count());
    }
  }
  return sum;
}

// Whether the film is taken; then it can be read to the last byte. Bytes beyond the block are not ours.
bool taken(const Block& block) {
  try {
    const PackedFilm view(block, "film");
    walk(view);
    return true;
  } catch (const Failure&) {
    return false;
  }
}

// Each damage would have nodes read what is not there, or put points where no bounds look for them.
TEST(FilmDamage, UnsoundSkinsAreRefused) {
  const auto refused = [](const auto& change) {
    FilmData film = small_film();
    change(film);
    return !taken(pack(film));
  };
  EXPECT_FALSE(refused([](FilmData&) {}));
  EXPECT_TRUE(refused([](FilmData& f) { f.segments[2].bone_count = 1; }));
  EXPECT_TRUE(refused([](FilmData& f) { f.segments[2].bone_count = 0; }));
  EXPECT_TRUE(refused([](FilmData& f) { f.segments[2].bone_count = 3; }));
  EXPECT_TRUE(refused([](FilmData& f) { f.segments[2].first_bone = 1; }));
  EXPECT_TRUE(refused([](FilmData& f) { f.segments[1].bone_count = 2; }));
  EXPECT_TRUE(refused([](FilmData& f) { f.bones[1] = {1, 30}; }));
  EXPECT_TRUE(refused([](FilmData& f) { f.bones[1] = {2, 2}; }));
  EXPECT_TRUE(refused([](FilmData& f) { f.shapes[2].bone_count = 1; }));
  EXPECT_TRUE(refused([](FilmData& f) { f.shapes[2].bone_count = 0; }));
  EXPECT_TRUE(refused([](FilmData& f) { f.shapes[2].patch_count = 2; }));
  EXPECT_TRUE(refused([](FilmData& f) { f.segments[2].blend = Blend{2}; }));
  EXPECT_TRUE(refused([](FilmData& f) { f.shapes[2].first_net_patch = 1; }));
  EXPECT_TRUE(refused([](FilmData& f) { f.net_points[1].skin.bone_count = 0; }));
  EXPECT_TRUE(refused([](FilmData& f) { f.net_points[1].skin.bone_count = 3; }));
  EXPECT_TRUE(refused([](FilmData& f) { f.net_points[1].skin.first_weight = 7; }));
  EXPECT_TRUE(refused([](FilmData& f) { f.net_points[0].place[1] = std::nanf(""); }));
  EXPECT_TRUE(refused([](FilmData& f) { f.stencils[1].term_count = 0; }));
  EXPECT_TRUE(refused([](FilmData& f) { f.stencils[1].first_term = 3; }));
  EXPECT_TRUE(refused([](FilmData& f) { f.stencil_terms[2].point = 2; }));
  EXPECT_TRUE(refused([](FilmData& f) { f.stencil_terms[1].point = 0; }));
  EXPECT_TRUE(refused([](FilmData& f) { f.net_patches[0].stencils[15] = 2; }));
  EXPECT_TRUE(refused([](FilmData& f) { f.net_patches[0].first_bone = 1; }));
  EXPECT_TRUE(refused([](FilmData& f) { f.net_patches[0].bone_count = 1; }));
  EXPECT_TRUE(refused([](FilmData& f) { f.net_patches[0].bone_count = 3; }));
  EXPECT_TRUE(refused([](FilmData& f) { f.skin_bones[2] = 1, f.skin_bones[3] = 0; }));
  for (const std::uint32_t superfluous : {2u, 4'000'000'000u})
    EXPECT_TRUE(refused([&](FilmData& f) {
      f.skin_bones.push_back(superfluous);
      f.net_patches[0].bone_count = 3;
    }));
  for (const float weight : {-0.5f, 0.0f, 0.7f, std::nanf("")})
    EXPECT_TRUE(refused([weight](FilmData& f) { f.stencil_terms[1].weight = weight; })) << weight;
  EXPECT_TRUE(refused([](FilmData& f) { f.skin_weights.back() = 0.4f; }));
  EXPECT_TRUE(refused([](FilmData& f) { f.shapes[1].bone_count = 2; }));
  EXPECT_TRUE(refused([](FilmData& f) { f.meshlets[2].skin.first_bone = 1; }));
  EXPECT_TRUE(refused([](FilmData& f) { f.meshlets[2].skin.bone_count = kMeshletBones + 1; }));
  EXPECT_TRUE(refused([](FilmData& f) { f.meshlets[2].skin.first_weight = 1; }));
  EXPECT_TRUE(refused([](FilmData& f) { f.skin_bones[0] = 1, f.skin_bones[1] = 0; }));
  EXPECT_TRUE(refused([](FilmData& f) { f.skin_bones[0] = 1; }));
  EXPECT_TRUE(refused([](FilmData& f) { f.skin_bones[1] = 2; }));
  for (const float weight : {-0.5f, 0.501f, 1.5f, std::nanf("")})
    EXPECT_TRUE(refused([weight](FilmData& f) { f.skin_weights[1] = weight; })) << weight;
}

TEST(FilmDamage, TruncatedAnywhereIsRefused) {
  const Block whole = pack(small_film());
  ASSERT_TRUE(taken(whole));
  const std::size_t padding = 63;  // the last section's end may be less than a section's alignment away
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const Block part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    const bool took = taken(part);
    EXPECT_FALSE(took && size + padding < whole.size()) << size << " of " << whole.size() << " bytes";
  }
}

TEST(FilmDamage, DamagedBytesDoNoHarm) {
  const Block whole = pack(small_film());
  shape::Random random(4);
  int refused = 0;
  for (int trial = 0; trial < 30000; ++trial) {
    Block block = whole;
    for (int flips = random.whole(1, 3); flips > 0; --flips) {
      const auto at = static_cast<std::size_t>(random.whole(0, static_cast<std::int32_t>(whole.size()) - 1));
      block[at] = static_cast<std::byte>(random.whole(0, 2) == 0 ? 0xff : random.whole(0, 255));
    }
    refused += !taken(block);
  }
  EXPECT_GT(refused, 3000);
}

TEST(FilmDamage, DamagedHeaderIsRefused) {
  const Block whole = pack(small_film());
  for (std::size_t at = 0; at < 16; ++at) {  // magic, version, number of sections
    Block block = whole;
    block[at] ^= std::byte{1};
    EXPECT_FALSE(taken(block)) << "byte " << at;
    EXPECT_THROW(PackedFilm(block, "film", true), Failure);
  }
  for (const std::uint64_t bad : {std::uint64_t{1}, std::uint64_t{1} << 40, ~std::uint64_t{63}, ~std::uint64_t{0}}) {
    for (std::size_t at = 16; at < 16 + 24 * 16; at += 16) {  // each section's offset
      Block block = whole;
      std::memcpy(&block[at], &bad, sizeof bad);
      EXPECT_FALSE(taken(block)) << "offset " << bad << " of section " << at / 16 - 1;
    }
  }
}

}  // namespace
}  // namespace mars::wire
