// What a viewer is given, against the film it was made of and against what figures 2.3 and 2.6 say.
#include "host/preview/wireframe.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <glm/geometric.hpp>
#include <set>

#include "host/content/animator/pose/figure.h"
#include "host/content/animator/reading/read_film.h"
#include "host/preview/load.h"
#include "host/preview/shape_lines.h"

namespace mars::preview {
namespace {

// An arm on a post: the post, a shoulder without a segment, a sheared forearm, and a tip without one.
constexpr const char* kArm = R"({
  "frames": 5, "camera": {"eye": [0, -6, 3], "at": [0, 0, 0]},
  "models": {"arm": {"joints": [
    {"name": "post", "segment": {"shape": "box", "sbb": [[-1, -1, 0], [1, 1, 4]]}},
    {"name": "shoulder", "parent": "post", "place": [0, 0, 4]},
    {"name": "forearm", "parent": "shoulder", "place": [1, 0, 0], "x_axis": [1, 0, 0], "y_axis": [0.6, 0.8, 0],
     "segment": {"shape": "cylinder", "sbb": [[0, -0.5, -0.5], [3, 0.5, 0.5]]}},
    {"name": "tip", "parent": "forearm", "place": [3, 0, 0]}]}},
  "actors": [{"name": "a", "model": "arm", "place": [5, 0, 0], "keys": [
    {"frame": 0, "turn": [0, 0, 0], "pose": {"shoulder": [0, 0, 0], "forearm": [0, 0, 0]}},
    {"frame": 4, "turn": [0, 0, 90], "pose": {"shoulder": [0, -90, 0], "forearm": [0, 45, 0]}}]},
    {"name": "b", "model": "arm", "place": [-5, 0, 0]}]
})";

animator::Film arm_film() { return animator::read_film(document::Document(kArm, "arm").root(), {}); }

glm::dvec3 placed(const Wireframe& wireframe, const Part& part, std::uint32_t frame, std::size_t point) {
  const Placing& m = wireframe.matrices[wireframe.value_at(part.motion, frame)];
  const float* p = &wireframe.lines[part.lines].points[3 * point];
  glm::dvec3 place;
  for (int r = 0; r < 3; ++r) {
    const auto at = static_cast<std::size_t>(4 * r);
    place[r] = double(m[at]) * p[0] + double(m[at + 1]) * p[1] + double(m[at + 2]) * p[2] + m[at + 3];
  }
  return place;
}

const std::vector<Part>& parts(const Wireframe& wireframe, As as) {
  return wireframe.parts[static_cast<std::size_t>(as)];
}

void expect_near(const glm::dvec3& is, const glm::dvec3& should) {
  EXPECT_LT(glm::length(is - should), 1e-5)
      << is.x << ' ' << is.y << ' ' << is.z << " is not " << should.x << ' ' << should.y << ' ' << should.z;
}

TEST(Wireframe, MatricesAreTheCompiledFilms) {
  const animator::Film film = arm_film();
  const film::CompiledFilm compiled = film::compile(film);
  const Wireframe wireframe = wireframe_of(compiled, &film);
  const wire::PackedFilm nodes = compiled.view();
  ASSERT_EQ(parts(wireframe, As::prisms).size(), nodes.segments().size());
  for (std::size_t i = 0; i < nodes.segments().size(); ++i)
    for (std::uint32_t frame = 0; frame < film.frames; ++frame)
      for (const As as : {As::vertices, As::prisms}) {
        const Placing& is = wireframe.matrices[wireframe.value_at(parts(wireframe, as)[i].motion, frame)];
        const wire::Matrix& should = nodes.matrix_at(nodes.segments()[i], frame);
        for (std::size_t k = 0; k < 12; ++k) EXPECT_EQ(is[k], static_cast<float>(should.m[k / 4][k % 4]));
      }
  EXPECT_EQ(wireframe.camera_at(4), nodes.camera_at(4));
}

TEST(Wireframe, OnlyWhatChangesHasMoreThanOneMatrix) {
  const animator::Film film = arm_film();
  const Wireframe wireframe = wireframe_of(film::compile(film), &film);
  for (const As as : {As::stick, As::prisms}) {
    std::size_t still = 0, moving = 0;
    for (const Part& part : parts(wireframe, as)) (part.motion.count == 1 ? still : moving) += 1;
    const std::size_t of_arm = as == As::stick ? 4 : 2;
    EXPECT_EQ(moving, of_arm);  // a
    EXPECT_EQ(still, of_arm);   // b
  }
}

TEST(Wireframe, SticksGoFromJointToJoint) {
  const animator::Film film = arm_film();
  const Wireframe wireframe = wireframe_of(film::compile(film), &film);
  const modeler::Model& model = film.models[0];
  for (std::size_t actor = 0; actor < 2; ++actor) {
    animator::Figure figure(model, film.actors[actor].motion);
    for (std::uint32_t frame = 0; frame < film.frames; ++frame) {
      figure.move_to(frame);
      // Segments' joints first, then bare ones, as parts come.
      const std::size_t joints[4] = {0, 2, 1, 3};
      for (std::size_t i = 0; i < 4; ++i) {
        const Part& part = parts(wireframe, As::stick)[4 * actor + i];
        expect_near(placed(wireframe, part, frame, 0), figure.frame_of(joints[i]).place);
        const std::size_t ends = wireframe.lines[part.lines].points.size() / 3 - 1;
        ASSERT_EQ(ends, joints[i] == 3 ? 0u : 1u);  // one child each, but the tip
        EXPECT_EQ(wireframe.lines[part.lines].ends.size(), 2 * ends);
        if (joints[i] < 3) expect_near(placed(wireframe, part, frame, 1), figure.frame_of(joints[i] + 1).place);
      }
    }
  }
}

TEST(Wireframe, ALimbsLastStickEndsAtItsSegmentsFarEnd) {
  const animator::Film film = arm_film();
  modeler::Model model = film.models[0];
  model.joints.pop_back();
  const std::vector<Lines> sticks = sticks_of(model);
  const std::vector<float> should{0, 0.5f, 0.5f, 1, 0.5f, 0.5f};  // in the unit cube: the joint, the face at x = 3
  EXPECT_EQ(sticks[2].points, should);
}

// The sheared forearm of frame 0, by hand: its frame is at (6, 0, 4), its axes (1, 0, 0), (0.6, 0.8, 0), (0, 0, 0.8).
TEST(Wireframe, PrismsAreTheBoxesOfSegments) {
  const animator::Film film = arm_film();
  const Wireframe wireframe = wireframe_of(film::compile(film), &film);
  const Part& part = parts(wireframe, As::prisms)[1];
  const Lines& cube = wireframe.lines[part.lines];
  EXPECT_EQ(cube.points.size(), 3u * 8);
  ASSERT_EQ(cube.ends.size(), 2u * 12);
  for (std::size_t corner = 0; corner < 8; ++corner) {
    const double x = corner & 1 ? 3 : 0, y = corner & 2 ? 0.5 : -0.5, z = corner & 4 ? 0.5 : -0.5;
    expect_near(placed(wireframe, part, 0, corner), {6 + x + 0.6 * y, 0.8 * y, 4 + 0.8 * z});
  }
  for (std::size_t i = 0; i < cube.ends.size(); i += 2) {
    const std::uint32_t differing = cube.ends[i] ^ cube.ends[i + 1];
    EXPECT_TRUE(differing == 1 || differing == 2 || differing == 4);
  }
}

wire::Patch flat_patch(float x) {
  wire::Patch patch;
  for (std::size_t i = 0; i < 16; ++i)
    patch.points[i] = {x + static_cast<float>(i % 4) / 8, static_cast<float>(i / 4) / 4, 0};
  return patch;
}

film::CompiledFilm film_of(const std::vector<wire::Patch>& patches) {
  animator::Film film = arm_film();
  film.models[0].shapes.assign(2, {"own", patches});
  return film::compile(film);
}

TEST(ControlNet, JoinsAllPointsOfAPatch) {
  const film::CompiledFilm film = film_of({flat_patch(0)});
  const Lines net = control_net(film.view(), film.view().shapes()[0]);
  EXPECT_EQ(net.points.size(), 3u * 16);
  EXPECT_EQ(net.ends.size(), 2u * 24);
  EXPECT_EQ(net.dots, 16u);
}

TEST(ControlNet, NeighboursShareTheirEdge) {
  const film::CompiledFilm film = film_of({flat_patch(0), flat_patch(3.0f / 8)});
  const Lines net = control_net(film.view(), film.view().shapes()[0]);
  EXPECT_EQ(net.points.size(), 3u * 28);
  EXPECT_EQ(net.ends.size(), 2u * (2 * 24 - 3));
}

TEST(ControlNet, LeavesOutLinesOfNoLength) {
  wire::Patch patch = flat_patch(0);
  for (std::size_t i = 1; i < 4; ++i) patch.points[i] = patch.points[0];
  const film::CompiledFilm film = film_of({patch});
  const Lines net = control_net(film.view(), film.view().shapes()[0]);
  EXPECT_EQ(net.points.size(), 3u * 13);
  EXPECT_EQ(net.ends.size(), 2u * 21);
}

// A tetrahedron with a meshlet for each sharp face, and a sheet of two B-spline patches, in all representations.
TEST(Wireframe, MeshesAndSplinesHaveAllRepresentations) {
  const char* const json = R"({"frames": 1, "camera": {"eye": [0, -6, 3]}, "models": {"m": {
    "shapes": {"solid": {"mesh": {"vertices": [[0,0,0], [1,0,0], [0,1,0], [0,0,1]],
                                  "faces": [[0,2,1], [0,1,3], [1,2,3], [0,3,2]]}},
               "sheet": {"bspline": {"points": [[[0,0,0], [0.25,0,1], [0.5,0,0], [0.75,0,1], [1,0,0]],
                                                [[0,1,0], [0.25,1,1], [0.5,1,0], [0.75,1,1], [1,1,0]]],
                                     "v": {"degree": 1}}}},
    "joints": [{"name": "a", "segment": {"shape": "solid", "sbb": [[0, 0, 0], [2, 2, 2]]}},
               {"name": "b", "parent": "a", "segment": {"shape": "sheet"}}]}},
    "actors": [{"name": "a", "model": "m"}]})";
  const animator::Film film = animator::read_film(document::Document(json, "film").root(), {});
  const film::CompiledFilm compiled = film::compile(film);
  const Wireframe wireframe = wireframe_of(compiled, &film);
  for (const As as : {As::stick, As::vertices, As::prisms}) ASSERT_EQ(parts(wireframe, as).size(), 2u);
  const Lines& solid = wireframe.lines[parts(wireframe, As::vertices)[0].lines];
  EXPECT_EQ(solid.points.size(), 3u * 4);
  EXPECT_EQ(solid.ends.size(), 2u * 6);
  const Lines& sheet = wireframe.lines[parts(wireframe, As::vertices)[1].lines];
  EXPECT_EQ(sheet.points.size(), 3u * (2 * 16 - 4));
  EXPECT_EQ(sheet.ends.size(), 2u * (2 * 24 - 3));
  expect_near(placed(wireframe, parts(wireframe, As::prisms)[0], 0, 7), {2, 2, 2});
}

TEST(Wireframe, ShapesAreStoredOnce) {
  const animator::Film film = arm_film();
  const Wireframe wireframe = wireframe_of(film::compile(film), &film);
  std::set<std::uint32_t> nets;
  for (const Part& part : parts(wireframe, As::vertices)) nets.insert(part.lines);
  EXPECT_EQ(nets.size(), 2u);
  // Two shapes, the cube, four joints' sticks, though there are two actors.
  EXPECT_EQ(wireframe.lines.size(), 7u);
}

TEST(Wireframe, ACompiledFilmAloneHasItsPrismsAxesAsSticks) {
  const animator::Film film = arm_film();
  const Wireframe wireframe = wireframe_of(film::compile(film), nullptr);
  EXPECT_TRUE(wireframe.sticks_of_prisms);
  ASSERT_EQ(parts(wireframe, As::stick).size(), 4u);
  expect_near(placed(wireframe, parts(wireframe, As::stick)[2], 0, 0), {-5, 0, 0});  // b's post, upright
  expect_near(placed(wireframe, parts(wireframe, As::stick)[2], 0, 1), {-5, 0, 4});
}

TEST(Wireframe, BallsHoldEverySegmentAtEveryFrame) {
  const animator::Film film = arm_film();
  const Wireframe wireframe = wireframe_of(film::compile(film), &film);
  for (const Part& part : parts(wireframe, As::prisms))
    for (std::uint32_t frame = 0; frame < film.frames; ++frame)
      for (std::size_t corner = 0; corner < 8; ++corner) {
        const glm::dvec3 place = placed(wireframe, part, frame, corner);
        EXPECT_LE(glm::length(place - wireframe.whole.center), wireframe.whole.radius);
        if (part.motion.count > 1) {
          EXPECT_LE(glm::length(place - wireframe.subject.center), wireframe.subject.radius);
        }
      }
  EXPECT_LT(wireframe.subject.radius, wireframe.whole.radius);
}

TEST(Load, AModelAloneIsSeenFromAllAround) {
  const Previewed human = load_previewed(std::filesystem::path(MARS_SOURCE_DIR) / "examples/models/human.json");
  EXPECT_EQ(human.wireframe.frames, 96u);
  EXPECT_EQ(human.wireframe.cameras.size(), 96u);
  const wire::Camera &first = human.wireframe.camera_at(0), &half = human.wireframe.camera_at(48);
  for (std::size_t i = 0; i < 3; ++i)  // looks the other way
    EXPECT_NEAR(first.world_to_eye.m[0][i], -half.world_to_eye.m[0][i], 1e-6);
}

}  // namespace
}  // namespace mars::preview
