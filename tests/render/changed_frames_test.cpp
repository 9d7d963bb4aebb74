// Every number of a compiled film is changed once: the frames that changed_frames() names are those whose pixels
// differ.
#include "host/content/film/changed_frames.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "host/content/film/frame_content.h"
#include "host/content/modeler/primitives.h"
#include "tests/render/film_run.h"
#include "tests/render/films.h"

namespace mars::test {
namespace {

using Frames = std::vector<std::uint32_t>;
using wire::FilmData;

const Frames kAll{0, 1, 2, 3}, kNone{};

// A further member of a struct below fails to compile here: compare it in changed_frames(), and change it below.
[[maybe_unused]] void name_members(const FilmData& film) {
  [[maybe_unused]] const auto& [a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11, a12, a13, a14, a15, a16, a17, a18, a19,
                                a20, a21, a22, a23, a24] = film;
  [[maybe_unused]] const auto& [b1, b2, b3, b4, b5, b6, b7, b8, b9, b10, b11, b12, b13, b14] = film.settings;
  [[maybe_unused]] const auto& [q1, q2, q3, q4] = film.settings.window;
  [[maybe_unused]] const auto& [c1, c2, c3, c4, c5, c6] = film.shapes[0];
  [[maybe_unused]] const auto& [d1, d2, d3, d4, d5, d6, d7] = film.meshlets[0];
  [[maybe_unused]] const auto& [r1, r2, r3] = film.meshlets[0].skin;
  [[maybe_unused]] const auto& [s1, s2] = film.net_points[0];
  [[maybe_unused]] const auto& [t1, t2] = film.stencil_terms[0];
  [[maybe_unused]] const auto& [u1, u2] = film.stencils[0];
  [[maybe_unused]] const auto& [e1, e2, e3, e4, e5, e6, e7, e8] = film.segments[0];
  [[maybe_unused]] const auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13] = film.materials[0];
  [[maybe_unused]] const auto& [g1, g2, g3, g4, g5, g6, g7, g8] = film.cameras[0];
  [[maybe_unused]] const auto& [h1, h2, h3, h4, h5, h6, h7, h8, h9] = film.lights[0];
  [[maybe_unused]] const auto& [i1, i2, i3, i4] = film.intervals[0];
  [[maybe_unused]] const auto& [k1, k2] = film.settings.ambient;
  [[maybe_unused]] const auto& [l1, l2, l3] = film.settings.fog;
  [[maybe_unused]] const auto& [m1] = film.matrices[0];
  [[maybe_unused]] const auto& [n1] = film.patches[0];
  [[maybe_unused]] const auto& [o1, o2] = film.changes[0];
  [[maybe_unused]] const auto& [p1, p2] = film.segments[0].motion;
}

// Of tracks, by what they move: where their changes begin.
constexpr std::size_t kBallMotion = 1, kMeshMaterial = 2;            // segments
constexpr std::size_t kPoint = 1, kSpot = 2;                         // lights
constexpr std::size_t kCook = 0, kPhong = 1, kMetal = 2, kLate = 3;  // materials

wire::Material material(wire::Reflection reflection, std::array<float, 3> color) {
  wire::Material made{color, 0.3f, 0.6f, 0.5f, 12, 2};
  made.reflection = reflection;
  made.roughness = 0.4f;
  made.metallic = 0.3f;
  return made;
}

// Four frames in two intervals: a ground, a ball that moves, a mesh that gets another material in frame 3, and half
// a ball, whose inside shows. Camera and light change where the second interval begins.
FilmData base() {
  FilmMaker maker(40, 30, 4);
  maker.add_material(material(wire::Reflection::cook_torrance, {0.8f, 0.4f, 0.2f}));
  maker.add_material(material(wire::Reflection::phong, {0.3f, 0.6f, 0.3f}));
  maker.add_material(material(wire::Reflection::metallic_roughness, {0.4f, 0.4f, 0.9f}));
  maker.add_material(material(wire::Reflection::blinn_phong, {0.9f, 0.3f, 0.4f}));
  const std::uint32_t box = maker.add_shape(modeler::make_box()), ball = maker.add_shape(modeler::make_sphere());
  const std::uint32_t mesh = maker.add_shape(modeler::cut_meshlets(mesh_ball(5, 180)));
  wire::Shape half = maker.film.shapes[ball];
  half.patch_count /= 2;
  maker.film.shapes.push_back(half);
  const std::uint32_t bowl = mesh + 1;
  maker.add_segment(box, kPhong, {placed({-6, -6, -12}, 12)});
  std::vector<wire::Matrix> motion;
  for (int f = 0; f < 4; ++f) motion.push_back(placed({-3 + 0.3 * f, -2, 0.5}, 2));
  maker.add_segment(ball, kCook, motion);
  maker.add_segment(mesh, kMetal, {placed({-0.5, -3, 0.2}, 2)});
  maker.add_segment(bowl, kPhong, {placed({1.5, -2, 0.2}, 2.5)});
  maker.add_light({wire::LightKind::directional, {-0.36f, -0.48f, 0.8f}, {0.5f, 0.5f, 0.5f}});
  maker.add_light({wire::LightKind::point, {3, -4, 5}, {0.6f, 0.6f, 0.9f}, {}, 1, 1, 8});
  maker.add_light({wire::LightKind::spot, {-4, -6, 6}, {0.9f, 0.9f, 0.5f}, {0.5f, 0.5f, -0.7f}, 0.95f, 0.8f, 0});
  const auto append = [&](wire::Track& track, wire::Change second) {
    const wire::Change first = maker.film.changes[track.first];
    track = {static_cast<std::uint32_t>(maker.film.changes.size()), 2};
    maker.film.changes.insert(maker.film.changes.end(), {first, second});
  };
  append(maker.film.segments[kMeshMaterial].material, {3, kLate});
  maker.film.lights.push_back(maker.film.lights[kPoint]);
  maker.film.lights.back().color = {0.9f, 0.2f, 0.2f};
  append(maker.film.light_tracks[kPoint], {2, 3});
  maker.set_cameras({looking({1, -11, 7}, {0, 0, 0}, 40)});
  maker.film.cameras.push_back(looking({1.5, -11, 7}, {0, 0, 0}, 40));
  append(maker.film.settings.camera, {2, 1});
  FilmData film = maker.make(2);
  film.moving = {1, 1, 2};
  film.intervals = {{0, 2, 0, 1}, {2, 2, 1, 2}};
  film.settings.color_space = wire::ColorSpace::linear;
  film.settings.samples = 2;
  film.settings.fog = {{0.3f, 0.3f, 0.4f}, 8, 30};
  film.settings.ambient = {{0.9f, 0.9f, 1}, {0.4f, 0.3f, 0.3f}};
  return film;
}

std::map<std::uint32_t, Pixels> rendered(const FilmData& film) { return run_film(FilmBlock(film).bytes()).frames; }

Frames differing(const std::map<std::uint32_t, Pixels>& before, const std::map<std::uint32_t, Pixels>& now) {
  Frames frames;
  for (const auto& [frame, pixels] : now)
    if (const auto found = before.find(frame); found == before.end() || found->second != pixels)
      frames.push_back(frame);
  return frames;
}

Frames found(const FilmData& before, const FilmData& now) {
  const FilmBlock a(before), b(now);
  const film::FrameContent of_a(a.view()), of_b(b.view());
  Frames changed = film::changed_frames(a.view(), b.view());
  for (std::uint32_t frame = 0; frame < std::min(before.settings.frames, now.settings.frames); ++frame)
    EXPECT_EQ(of_a.checksum(frame) != of_b.checksum(frame), std::ranges::binary_search(changed, frame)) << frame;
  return changed;
}

struct Edit {
  const char* of;
  std::function<void(FilmData&)> make;
  Frames frames;  // that show it
};

std::vector<Edit> edits_of_settings() {
  return {
      {"width", [](FilmData& f) { f.settings.width = 41; }, kAll},
      {"height", [](FilmData& f) { f.settings.height = 31; }, kAll},
      {"dice", [](FilmData& f) { f.settings.dice = 2; }, kAll},
      {"background", [](FilmData& f) { f.settings.background[1] = 0.5f; }, kAll},
      {"rate", [](FilmData& f) { f.settings.rate = 25; }, kNone},
      {"camera", [](FilmData& f) { f.settings.camera.count = 1; }, {2, 3}},
      {"samples", [](FilmData& f) { f.settings.samples = 4; }, kAll},
      {"color_space", [](FilmData& f) { f.settings.color_space = wire::ColorSpace::coded; }, kAll},
      {"curve", [](FilmData& f) { f.settings.curve = wire::Curve::filmic; }, kAll},
      {"ambient.sky", [](FilmData& f) { f.settings.ambient.sky[0] = 0.2f; }, kAll},
      {"ambient.ground", [](FilmData& f) { f.settings.ambient.ground[0] = 0.9f; }, kAll},
      {"fog.color", [](FilmData& f) { f.settings.fog.color[2] = 0.9f; }, kAll},
      {"fog.start", [](FilmData& f) { f.settings.fog.start = 2; }, kAll},
      {"fog.end", [](FilmData& f) { f.settings.fog.end = 20; }, kAll},
      {"window",
       [](FilmData& f) {
         f.settings.window = {2, 1, f.settings.width, f.settings.height};
       },
       kAll},
      {"pixel_aspect", [](FilmData& f) { f.settings.pixel_aspect = 2; }, kAll},
  };
}

std::vector<Edit> edits_of_shapes() {
  return {
      {"patch",
       [](FilmData& f) {
         for (wire::Patch& patch : f.patches) patch.points[5][2] += 0.2f;
       },
       kAll},
      {"place",
       [](FilmData& f) {
         f.meshlets[0].high[2] += 0.3f;
         for (auto& place : f.mesh_places) place[2] += 0.3f;
       },
       kAll},
      {"normal",
       [](FilmData& f) {
         f.mesh_normals.assign(f.mesh_normals.size(), {0, 0, 1});
       },
       kAll},
      {"triangle",
       [](FilmData& f) {
         for (auto& triangle : f.mesh_triangles) triangle = {triangle[0], triangle[0], triangle[0]};
       },
       kAll},
      {"patch_count", [](FilmData& f) { f.shapes[0].patch_count = 1; }, kAll},
      {"first_patch", [](FilmData& f) { f.shapes[1].first_patch -= 1; }, kAll},
      {"meshlet_count", [](FilmData& f) { f.shapes[2].meshlet_count = 0; }, kAll},
      {"triangle_count", [](FilmData& f) { f.meshlets[0].triangle_count = 40; }, kAll},
      {"segment.shape", [](FilmData& f) { f.segments[kBallMotion].shape = 0; }, kAll},
      {"a segment more",
       [](FilmData& f) { f.segments.push_back(f.segments[kMeshMaterial]), f.segments.back().shape = 0; }, kAll},
      {"segment.name", [](FilmData& f) { f.segments[0].name = 1; }, kNone},
      {"names", [](FilmData& f) { f.names[0] = 'x'; }, kNone},
  };
}

std::vector<Edit> edits_of_values() {
  return {
      {"matrix", [](FilmData& f) { f.matrices[2].m[2][3] += 0.5; }, {1}},
      {"motion", [](FilmData& f) { f.segments[kBallMotion].motion.count = 3; }, {3}},
      {"change.frame", [](FilmData& f) { f.changes[f.segments[kBallMotion].motion.first + 3].frame = 4; }, {3}},
      {"change.value", [](FilmData& f) { f.changes[f.segments[kBallMotion].motion.first + 3].value = 1; }, {3}},
      {"material", [](FilmData& f) { f.segments[kMeshMaterial].material.count = 1; }, {3}},
      {"world_to_eye", [](FilmData& f) { f.cameras[1].world_to_eye.m[0][3] += 0.5; }, {2, 3}},
      {"focal", [](FilmData& f) { f.cameras[0].focal *= 1.1; }, {0, 1}},
      {"near", [](FilmData& f) { f.cameras[1].near = 11; }, {2, 3}},
      {"far", [](FilmData& f) { f.cameras[0].far = 11; }, {0, 1}},
      {"exposure", [](FilmData& f) { f.cameras[1].exposure = 2; }, {2, 3}},
      {"shift_x", [](FilmData& f) { f.cameras[0].shift_x = 0.1; }, {0, 1}},
      {"shift_y", [](FilmData& f) { f.cameras[1].shift_y = 0.1; }, {2, 3}},
      {"projection",
       [](FilmData& f) {
         for (wire::Camera& camera : f.cameras) camera.projection = wire::Projection::orthographic;
       },
       kAll},
      {"light.kind", [](FilmData& f) { f.lights[kSpot].kind = wire::LightKind::point; }, kAll},
      {"light.vector",
       [](FilmData& f) {
         f.lights[0].vector = {0, 0, 1};
       },
       kAll},
      {"light.color", [](FilmData& f) { f.lights[3].color[1] = 0.9f; }, {2, 3}},
      {"light.axis",
       [](FilmData& f) {
         f.lights[kSpot].axis = {0.3f, 0.5f, -0.8f};
       },
       kAll},
      {"light.cos_inner", [](FilmData& f) { f.lights[kSpot].cos_inner = 0.85f; }, kAll},
      {"light.cos_outer", [](FilmData& f) { f.lights[kSpot].cos_outer = 0.9f; }, kAll},
      {"light.reach", [](FilmData& f) { f.lights[kPoint].reach = 3; }, {0, 1}},
      {"light_tracks", [](FilmData& f) { f.light_tracks[kPoint].count = 1; }, {2, 3}},
      {"a light less", [](FilmData& f) { f.light_tracks.pop_back(); }, kAll},
  };
}

std::vector<Edit> edits_of_materials() {
  return {
      {"color", [](FilmData& f) { f.materials[kLate].color[2] = 0.9f; }, {3}},
      {"ambient", [](FilmData& f) { f.materials[kPhong].ambient = 0.6f; }, kAll},
      {"diffuse", [](FilmData& f) { f.materials[kPhong].diffuse = 0.3f; }, kAll},
      {"specular", [](FilmData& f) { f.materials[kCook].specular = 2; }, kAll},
      {"exponent", [](FilmData& f) { f.materials[kLate].exponent = 3; }, {3}},
      {"sides", [](FilmData& f) { f.materials[kPhong].sides = 1; }, kAll},
      {"interpolation", [](FilmData& f) { f.materials[kCook].interpolation = wire::Interpolation::flat; }, kAll},
      {"reflection", [](FilmData& f) { f.materials[kLate].reflection = wire::Reflection::cook_torrance; }, {3}},
      {"roughness", [](FilmData& f) { f.materials[kCook].roughness = 0.2f; }, kAll},
      {"metallic", [](FilmData& f) { f.materials[kMetal].metallic = 0.9f; }, {0, 1, 2}},
      {"refraction", [](FilmData& f) { f.materials[kCook].refraction = 2.5f; }, kAll},
  };
}

std::vector<Edit> edits_of_shadows() {
  return {
      {"light.casts", [](FilmData& f) { f.lights[0].casts = 0; }, kAll},
      {"light.size", [](FilmData& f) { f.lights[0].size = 0.2f; }, kAll},
      {"casts", [](FilmData& f) { f.materials[kCook].casts = 0; }, kAll},
      {"receives", [](FilmData& f) { f.materials[kPhong].receives = 0; }, kAll},
  };
}

TEST(ChangedFrames, OfShadowsAreFound) {
  FilmData before = base();
  before.lights[0].casts = 1;
  for (const Edit& edit : edits_of_shadows()) {
    FilmData now = before;
    edit.make(now);
    EXPECT_EQ(found(before, now), edit.frames) << edit.of;
    EXPECT_EQ(found(now, before), edit.frames) << edit.of;
  }
}

TEST(ChangedFrames, AreThoseWhosePixelsDiffer) {
  const FilmData before = base();
  const auto pixels = rendered(before);
  EXPECT_EQ(found(before, before), kNone);
  for (const auto& edits : {edits_of_settings(), edits_of_shapes(), edits_of_values(), edits_of_materials()})
    for (const Edit& edit : edits) {
      FilmData now = base();
      edit.make(now);
      EXPECT_EQ(found(before, now), edit.frames) << edit.of;
      EXPECT_EQ(found(now, before), edit.frames) << edit.of;
      EXPECT_EQ(differing(pixels, rendered(now)), edit.frames) << edit.of;
    }
}

TEST(ChangedFrames, OfALongerFilmAreThoseItHadNot) {
  const FilmData before = base();
  FilmData longer = base();
  longer.settings.frames = 6;
  longer.intervals.back().frame_count = 4;
  EXPECT_EQ(found(before, longer), (Frames{4, 5}));
  EXPECT_EQ(found(longer, before), kNone);
  EXPECT_EQ(differing(rendered(before), rendered(longer)), (Frames{4, 5}));
}

// Which segments move in a frame's interval decides pixels (docs/exactness.md); where intervals are cut does not.
TEST(ChangedFrames, IntervalsCountByWhatMovesInThem) {
  const FilmData before = base();
  FilmData movers = base();
  movers.moving = {1, 1, 2, 3};
  movers.intervals[1].moving_count = 3;
  EXPECT_EQ(found(before, movers), (Frames{2, 3}));
  FilmData cut = base();
  cut.intervals = {{0, 1, 0, 1}, {1, 1, 0, 1}, {2, 2, 1, 2}};
  EXPECT_EQ(found(before, cut), kNone);
  EXPECT_EQ(differing(rendered(before), rendered(cut)), kNone);
}

// The same film, but everything lies elsewhere in it.
TEST(ChangedFrames, DoNotDependOnWhereValuesLie) {
  FilmData moved = base();
  moved.patches.insert(moved.patches.begin(), moved.patches[3]);
  for (wire::Shape& shape : moved.shapes) ++shape.first_patch;
  moved.matrices.insert(moved.matrices.begin(), moved.matrices[3]);
  const auto shift = [&](const wire::Track& track) {
    for (std::uint32_t i = 0; i < track.count; ++i) ++moved.changes[track.first + i].value;
  };
  for (const wire::Segment& segment : moved.segments) shift(segment.motion);
  EXPECT_EQ(found(base(), moved), kNone);
  EXPECT_EQ(differing(rendered(base()), rendered(moved)), kNone);
}

}  // namespace
}  // namespace mars::test
