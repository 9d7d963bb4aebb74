// The compiled film as a block: what is packed is read back, and what is unsound in it is refused.
#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "hal/failure/failure.h"
#include "node/wire/film.h"
#include "tests/node/wire/small_film.h"

namespace mars::wire {
namespace {

using Block = std::vector<std::byte>;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <typename Items, typename Read>
void expect_same(const Items& items, const Read& read) {
  ASSERT_EQ(items.size(), read.size());
  EXPECT_EQ(std::memcmp(items.data(), read.data(), items.size() * sizeof items[0]), 0);
}

TEST(FilmBlock, IsReadAsItWasPacked) {
  const FilmData film = small_film();
  const Block block = pack(film);
  for (const bool trusted : {false, true}) {
    const PackedFilm view(block, "film", trusted);
    EXPECT_EQ(std::memcmp(&film.settings, &view.settings(), sizeof film.settings), 0);
    expect_same(film.patches, view.patches());
    expect_same(film.mesh_places, view.mesh_places());
    expect_same(film.mesh_normals, view.mesh_normals());
    expect_same(film.mesh_triangles, view.mesh_triangles());
    expect_same(film.net_points, view.net_points());
    expect_same(film.stencil_terms, view.stencil_terms());
    expect_same(film.stencils, view.stencils());
    expect_same(film.net_patches, view.net_patches());
    expect_same(film.skin_bones, view.skin_bones());
    expect_same(film.skin_weights, view.skin_weights());
    expect_same(film.meshlets, view.meshlets());
    expect_same(film.shapes, view.shapes());
    expect_same(film.segments, view.segments());
    expect_same(film.bones, view.bones());
    expect_same(film.materials, view.materials());
    expect_same(film.matrices, view.matrices());
    expect_same(film.cameras, view.cameras());
    expect_same(film.lights, view.lights());
    expect_same(film.light_tracks, view.light_tracks());
    expect_same(film.changes, view.changes());
    expect_same(film.intervals, view.intervals());
  }
}

TEST(FilmBlock, AnswersWhatHoldsAtAFrame) {
  const Block block = pack(small_film());
  const PackedFilm film(block, "film");
  EXPECT_EQ(film.name(film.segments()[0]), "base");
  EXPECT_EQ(film.name(film.segments()[1]), "arm");
  EXPECT_EQ(film.patch_instances(), 7u);
  for (std::uint32_t frame = 0; frame < 3; ++frame) {
    EXPECT_EQ(film.matrix_at(film.segments()[0], frame), moved(0));
    EXPECT_EQ(film.matrix_at(film.segments()[1], frame), moved(frame));
    EXPECT_EQ(film.value_at(film.light_tracks()[1], frame), frame == 2 ? 1u : 0u);
    EXPECT_EQ(film.material_at(film.segments()[0], frame).exponent, 20.0f);
    EXPECT_EQ(film.camera_at(frame).focal, 2.0);
  }
  EXPECT_EQ(film.moving(film.intervals()[0]).size(), 2u);
  EXPECT_EQ(film.moving(film.intervals()[1])[1], 1u);
}

struct Defect {
  const char* name;
  std::function<void(FilmData&)> make;
};

void expect_refused(const std::vector<Defect>& defects) {
  for (const Defect& defect : defects) {
    FilmData film = small_film();
    defect.make(film);
    const Block block = pack(film);
    try {
      const PackedFilm view(block, "some.mars");
      ADD_FAILURE() << "taken though " << defect.name;
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.where, "some.mars");
      EXPECT_FALSE(failure.problem.empty());
      EXPECT_FALSE(failure.remedy.empty());
    }
  }
}

TEST(FilmBlock, RefusesNumbersOutOfRange) {
  std::vector<Defect> defects{
      {"width 0", [](FilmData& f) { f.settings.width = 0; }},
      {"width too large", [](FilmData& f) { f.settings.width = kMaxSide + 1; }},
      {"height 0", [](FilmData& f) { f.settings.height = 0; }},
      {"height too large", [](FilmData& f) { f.settings.height = 0xffffffff; }},
      {"left of the margin",
       [](FilmData& f) {
         f.settings.window = {-8193, 0, 64, 36};
       }},
      {"below the margin",
       [](FilmData& f) {
         f.settings.window = {0, 8229, 64, 36};
       }},
      {"whole width too large",
       [](FilmData& f) {
         f.settings.window = {0, 0, kMaxSide + 1, 36};
       }},
      {"whole height 0",
       [](FilmData& f) {
         f.settings.window = {0, 0, 64, 0};
       }},
      {"a place in no picture", [](FilmData& f) { f.settings.window.left = 1; }},
      {"pixel aspect 0", [](FilmData& f) { f.settings.pixel_aspect = 0; }},
      {"pixel aspect 17", [](FilmData& f) { f.settings.pixel_aspect = 17; }},
      {"no frame", [](FilmData& f) { f.settings.frames = 0, f.intervals.clear(); }},
      {"dice too fine", [](FilmData& f) { f.settings.dice = 257; }},
      {"rate 0", [](FilmData& f) { f.settings.rate = 0; }},
      {"exponent below 0", [](FilmData& f) { f.materials[1].exponent = -1; }},
      {"exponent too large", [](FilmData& f) { f.materials[1].exponent = 65536; }},
      {"no side", [](FilmData& f) { f.materials[0].sides = 0; }},
      {"three sides", [](FilmData& f) { f.materials[0].sides = 3; }},
      {"focal 0", [](FilmData& f) { f.cameras[0].focal = 0; }},
      {"near 0", [](FilmData& f) { f.cameras[0].near = 0; }},
      {"shift to the right", [](FilmData& f) { f.cameras[0].shift_x = 1.01; }},
      {"shift down", [](FilmData& f) { f.cameras[0].shift_y = -1.01; }},
      {"no projection", [](FilmData& f) { f.cameras[0].projection = static_cast<Projection>(3); }},
      {"far before near", [](FilmData& f) { f.cameras[0].far = 0.05; }},
      {"a material that casts twice", [](FilmData& f) { f.materials[1].casts = 2; }},
      {"a material that receives twice", [](FilmData& f) { f.materials[1].receives = 2; }},
      {"a light that casts twice", [](FilmData& f) { f.lights[0].casts = 2; }},
      {"a light smaller than a point", [](FilmData& f) { f.lights[0].size = -1; }},
      {"light of no kind", [](FilmData& f) { f.lights[1].kind = static_cast<LightKind>(3); }},
  };
  for (const double bad : {kNan, kInfinity, -kInfinity, 1e30}) {
    const auto b = static_cast<float>(bad);
    defects.insert(defects.end(), {{"background", [=](FilmData& f) { f.settings.background[2] = b; }},
                                   {"rate", [=](FilmData& f) { f.settings.rate = b; }},
                                   {"patch", [=](FilmData& f) { f.patches[2].points[15][2] = b; }},
                                   {"vertex", [=](FilmData& f) { f.mesh_places[6][1] = b; }},
                                   {"normal", [=](FilmData& f) { f.mesh_normals[0][2] = b; }},
                                   {"box", [=](FilmData& f) { f.meshlets[1].low[1] = b; }},
                                   {"color", [=](FilmData& f) { f.materials[1].color[1] = b; }},
                                   {"ambient", [=](FilmData& f) { f.materials[1].ambient = b; }},
                                   {"diffuse", [=](FilmData& f) { f.materials[1].diffuse = b; }},
                                   {"specular", [=](FilmData& f) { f.materials[1].specular = b; }},
                                   {"exponent", [=](FilmData& f) { f.materials[1].exponent = b; }},
                                   {"matrix", [=](FilmData& f) { f.matrices[2].m[2][3] = bad; }},
                                   {"camera's matrix", [=](FilmData& f) { f.cameras[0].world_to_eye.m[0][0] = bad; }},
                                   {"focal", [=](FilmData& f) { f.cameras[0].focal = bad; }},
                                   {"near", [=](FilmData& f) { f.cameras[0].near = bad; }},
                                   {"shift", [=](FilmData& f) { f.cameras[0].shift_x = bad; }},
                                   {"far", [=](FilmData& f) { f.cameras[0].far = bad; }},
                                   {"light", [=](FilmData& f) { f.lights[1].vector[0] = b; }},
                                   {"light's size", [=](FilmData& f) { f.lights[1].size = b; }},
                                   {"light's colour", [=](FilmData& f) { f.lights[0].color[2] = b; }}});
  }
  expect_refused(defects);
}

TEST(FilmBlock, RefusesBrokenIndices) {
  expect_refused({
      {"a shape begins beyond the patches", [](FilmData& f) { f.shapes[1].first_patch = 4; }},
      {"a shape ends beyond the patches", [](FilmData& f) { f.shapes[0].patch_count = 4; }},
      {"a shape wraps round", [](FilmData& f) { f.shapes[1].patch_count = 0xffffffff; }},
      {"a shape begins beyond the meshlets", [](FilmData& f) { f.shapes[1].first_meshlet = 1; }},
      {"a shape ends beyond the meshlets", [](FilmData& f) { f.shapes[1].meshlet_count = 3; }},
      {"a shape's meshlets wrap round",
       [](FilmData& f) {
         f.shapes[0] = {0, 2, 2, 0xffffffff};
       }},
      {"a meshlet begins beyond the vertices", [](FilmData& f) { f.meshlets[1].first_vertex = 5; }},
      {"a meshlet ends beyond the vertices", [](FilmData& f) { f.meshlets[1].vertex_count = 4; }},
      {"a meshlet begins beyond the triangles", [](FilmData& f) { f.meshlets[1].first_triangle = 3; }},
      {"a meshlet ends beyond the triangles", [](FilmData& f) { f.meshlets[0].triangle_count = 4; }},
      {"a meshlet has no vertices", [](FilmData& f) { f.meshlets[0].vertex_count = 0; }},
      {"a meshlet has no triangles", [](FilmData& f) { f.meshlets[0].triangle_count = 0; }},
      {"a meshlet has too many vertices",
       [](FilmData& f) {
         f.mesh_places.resize(300);
         f.mesh_normals.resize(300);
         f.meshlets[0] = {7, kMeshletVertices + 1, 0, 1, {0, 0, 0}, {0, 0, 0}};
       }},
      {"a meshlet has too many triangles",
       [](FilmData& f) {
         f.mesh_triangles.resize(300);
         f.meshlets[0].triangle_count = kMeshletTriangles + 1;
       }},
      {"a triangle has no such vertex", [](FilmData& f) { f.mesh_triangles[1][2] = 4; }},
      {"a vertex leaves its meshlet's box", [](FilmData& f) { f.mesh_places[3][2] = 0.6f; }},
      {"a meshlet's box is upside down", [](FilmData& f) { std::swap(f.meshlets[0].low, f.meshlets[0].high); }},
      {"a vertex has no normal", [](FilmData& f) { f.mesh_normals.pop_back(); }},
      {"a segment has no shape", [](FilmData& f) { f.segments[1].shape = 3; }},
      {"a segment has no name", [](FilmData& f) { f.segments[1].name = 9; }},
      {"names do not end", [](FilmData& f) { f.names.back() = 'x'; }},
      {"there are no names", [](FilmData& f) { f.names.clear(); }},
      {"no camera", [](FilmData& f) { f.cameras.clear(); }},
      {"the camera's track is empty", [](FilmData& f) { f.settings.camera.count = 0; }},
      {"a motion is empty", [](FilmData& f) { f.segments[0].motion.count = 0; }},
      {"a motion begins beyond the changes", [](FilmData& f) { f.segments[0].motion.first = 7; }},
      {"a motion ends beyond the changes", [](FilmData& f) { f.segments[1].motion.count = 6; }},
      {"a motion wraps round",
       [](FilmData& f) {
         f.segments[1].motion = {2, 0xffffffff};
       }},
      {"a motion has no such matrix", [](FilmData& f) { f.changes[3].value = 3; }},
      {"a motion begins late",
       [](FilmData& f) {
         f.segments[1].motion = {2, 1};
       }},
      {"a motion goes back", [](FilmData& f) { f.changes[3].frame = 0; }},
      {"a motion stays", [](FilmData& f) { f.changes[3].frame = 1; }},
      {"a segment has no such material",
       [](FilmData& f) {
         f.segments[0].material = {1, 3};
       }},
      {"a light has no such value",
       [](FilmData& f) {
         f.light_tracks[1] = {1, 3};
       }},
      {"intervals begin late", [](FilmData& f) { f.intervals[0].first_frame = 1; }},
      {"intervals leave a gap", [](FilmData& f) { f.intervals[0].frame_count = 1; }},
      {"an interval is empty", [](FilmData& f) { f.intervals[0].frame_count = 0; }},
      {"intervals end early", [](FilmData& f) { f.intervals.pop_back(); }},
      {"intervals end late", [](FilmData& f) { f.intervals[1].frame_count = 2; }},
      {"movers end beyond the list", [](FilmData& f) { f.intervals[1].moving_count = 4; }},
      {"movers begin beyond the list",
       [](FilmData& f) {
         f.intervals[1] = {2, 1, 6, 0};
       }},
      {"movers twice", [](FilmData& f) { f.moving[1] = 1; }},
      {"movers in no order", [](FilmData& f) { std::swap(f.moving[1], f.moving[2]); }},
      {"a mover is neither segment nor bone", [](FilmData& f) { f.moving[4] = 5; }},
  });
}

}  // namespace
}  // namespace mars::wire
