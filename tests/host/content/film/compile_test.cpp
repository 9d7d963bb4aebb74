#include "host/content/film/compile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "tests/host/content/document/failure_of.h"
#include "tests/host/content/film/small_film.h"

namespace mars::film {
namespace {

std::uint32_t changes_of(const wire::PackedFilm& film, std::size_t segment) {
  return film.segments()[segment].motion.count;
}

TEST(Compile, StoresOnlyWhatChanges) {
  const CompiledFilm film = compiled(arm_film(R"({"name": "x", "model": "arm", "keys": [
      {"frame": 4, "pose": {"b": [0, 0, 0]}}, {"frame": 8, "pose": {"b": [0, 80, 0]}},
      {"frame": 12, "pose": {"b": [0, 80, 0]}}]}, {"name": "y", "model": "arm", "place": [0, 5, 0]})"));
  const wire::PackedFilm view = film.view();
  ASSERT_EQ(view.segments().size(), 4u);
  EXPECT_EQ(view.shapes().size(), 2u) << "actors of one model share its shapes";
  EXPECT_EQ(changes_of(view, 0), 1u);
  EXPECT_EQ(changes_of(view, 1), 5u) << "frames 0, 5, 6, 7, 8";
  EXPECT_EQ(changes_of(view, 2), 1u);
  EXPECT_EQ(view.name(view.segments()[3]), "y/b");
  EXPECT_EQ(film.actors, 2u);
  EXPECT_EQ(film.joints, 4u);
}

// Meshes beside patches, in the order of the segments; the same mesh in two models is stored once.
TEST(Compile, StoresEqualMeshesOnce) {
  const auto model = [](const char* name, const char* crease) {
    return std::string("\"") + name + R"(": {"shapes": {"hut": {"mesh": {
        "vertices": [[0,0,0], [1,0,0], [1,1,0], [0,1,0], [0.5,0.5,1]],
        "faces": [[3,2,1,0], [0,1,4], [1,2,4], [2,3,4], [3,0,4]], "crease": )" +
           crease + R"(}}},
        "joints": [{"name": "a", "segment": {"shape": "hut"}},
                   {"name": "b", "parent": "a", "segment": {"shape": "box"}}]})";
  };
  const CompiledFilm film = compiled(R"({"frames": 3, "camera": {"eye": [0, -9, 2]}, "models": {)" + model("m", "30") +
                                     "," + model("n", "30") + "," + model("o", "180") + R"(}, "actors": [
      {"name": "x", "model": "m"}, {"name": "y", "model": "n", "place": [2, 0, 0]}, {"name": "z", "model": "o"}]})");
  const wire::PackedFilm view = film.view();
  wire::PackedFilm(film.block(), "f.json");
  ASSERT_EQ(view.segments().size(), 6u);
  EXPECT_EQ(view.shapes().size(), 3u) << "flat, box, smooth";
  EXPECT_EQ(view.segments()[0].shape, view.segments()[2].shape);
  EXPECT_NE(view.segments()[0].shape, view.segments()[4].shape);
  EXPECT_EQ(view.mesh_triangles().size(), 12u);
  EXPECT_EQ(view.mesh_places().size(), 16u + 5u) << "sharp edges: a vertex for each face; smooth: one for all";
  EXPECT_EQ(view.patch_instances(), 3u * (1 + 6));
}

TEST(Compile, FindsMaterialsOfModelFilmAndActor) {
  const CompiledFilm film = compiled(arm_film(R"({"name": "x", "model": "arm"},
      {"name": "y", "model": "arm", "material": "glow"}, {"name": "z", "model": "arm", "materials": {"red": "glow"}})",
                                              R"("frames": 20, "color": "coded")"));
  const wire::PackedFilm view = film.view();
  const auto color = [&](std::size_t segment) { return view.material_at(view.segments()[segment], 0).color[1]; };
  EXPECT_EQ(color(0), 0.8f) << "the default material";
  EXPECT_EQ(color(1), 0.0f);
  EXPECT_EQ(color(2), 0.8f);
  EXPECT_EQ(view.material_at(view.segments()[2], 4).ambient, float(1.0 / 3));
  EXPECT_EQ(view.material_at(view.segments()[4], 4).ambient, 0.1f);
  EXPECT_EQ(view.material_at(view.segments()[5], 19).ambient, 1.0f);
}

TEST(Compile, CameraLooksAtItsPlace) {
  const CompiledFilm film = compiled(R"({"frames": 1, "models": {}, "actors": [],
      "camera": {"eye": [3, -4, 12], "at": [0, 0, 0], "fov": 90}})");
  const wire::Camera& camera = film.view().camera_at(0);
  const auto at = [&](const glm::dvec3& p) {
    glm::dvec3 q;
    for (int row = 0; row < 3; ++row) {
      const auto& m = camera.world_to_eye.m[row];
      q[row] = m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3];
    }
    return q;
  };
  EXPECT_NEAR(camera.focal, 1, 1e-15);
  EXPECT_NEAR(at({0, 0, 0}).z, -13, 1e-12);
  EXPECT_NEAR(at({0, 0, 0}).x, 0, 1e-12);
  EXPECT_GT(at({0, 0, 1}).y, 0.1) << "z is up";
  EXPECT_NEAR(at({0, 0, 1}).x, 0, 1e-12);
  EXPECT_GT(at({4, 3, 0}).x, 1) << "x to the right";
}

TEST(Compile, CameraHasItsProjectionAndShift) {
  const CompiledFilm film = compiled(R"({"frames": 9, "models": {}, "actors": [], "camera": {
      "eye": [3, -4, 12], "projection": "orthographic", "shift": [0.25, -0.5],
      "keys": [{"frame": 0, "height": 4}, {"frame": 8, "height": 8}]}})");
  const auto camera = [&](std::uint32_t frame) { return film.view().camera_at(frame); };
  EXPECT_EQ(camera(0).projection, wire::Projection::orthographic);
  EXPECT_EQ(camera(0).focal, 0.5) << "2 / focal is what it shows";
  EXPECT_NEAR(camera(4).focal, 2.0 / 6, 1e-15);
  EXPECT_EQ(camera(4).shift_x, 0.25);
  EXPECT_EQ(camera(8).shift_y, -0.5);
  const CompiledFilm shifting = compiled(R"({"frames": 3, "models": {}, "actors": [], "camera": {"eye": [3, -4, 12],
      "keys": [{"frame": 0, "shift": [0, 0]}, {"frame": 2, "shift": [0.5, 1]}]}})");
  EXPECT_EQ(shifting.view().camera_at(1).shift_x, 0.25);
  EXPECT_EQ(shifting.view().camera_at(1).shift_y, 0.5);
  EXPECT_EQ(shifting.view().camera_at(1).projection, wire::Projection::perspective);
}

// Where a camera that looks along y from the origin shows a place, in widths of the picture from its left edge.
double shown_at(const wire::Camera& camera, double aspect, double x, double y) {
  const double across = x + camera.world_to_eye.m[0][3];
  return 0.5 - camera.shift_x + camera.focal * across / y / (2 * aspect);
}

TEST(Compile, EyesOfAStereoPairAgreeAtTheirConvergence) {
  const std::string film = R"({"frames": 1, "size": [320, 160], "models": {}, "actors": [], "camera": {
      "eye": [0, 0, 0], "at": [0, 1, 0], "shift": [0.1, 0.2], "interaxial": 0.5, "convergence": 4}})";
  const auto seen_by = [&](Eye eye) { return compile(film_of(film), {.eye = eye}).view().camera_at(0); };
  const wire::Camera left = seen_by(Eye::left), right = seen_by(Eye::right), middle = seen_by(Eye::middle);
  EXPECT_EQ(left.world_to_eye.m[0][3], 0.25) << "what is ahead is to the right of the left eye";
  EXPECT_EQ(right.world_to_eye.m[0][3], -0.25);
  EXPECT_EQ(left.shift_y, 0.2);
  for (const double x : {-1.0, 0.0, 1.5}) {
    EXPECT_NEAR(shown_at(left, 2, x, 4), shown_at(middle, 2, x, 4), 1e-12);
    EXPECT_NEAR(shown_at(right, 2, x, 4), shown_at(middle, 2, x, 4), 1e-12);
    EXPECT_GT(shown_at(left, 2, x, 3), shown_at(right, 2, x, 3)) << "crossed before the screen";
    EXPECT_LT(shown_at(left, 2, x, 5), shown_at(right, 2, x, 5));
  }
}

TEST(Compile, RefusesEyesThatSeeNothing) {
  const auto reported = [](const std::string& keys) {
    return document::failure_of([&] {
      compile(film_of(R"({"frames": 1, "models": {}, "actors": [], "camera": {"eye": [3, -4, 12], )" + keys + "}}"),
              {.eye = Eye::left});
    });
  };
  EXPECT_TRUE(document::holds(reported(R"("projection": "orthographic")"), "has no stereo pair"));
  EXPECT_TRUE(document::holds(reported(R"("interaxial": 9, "convergence": 1)"), "farther apart"));
}

TEST(Compile, RefusesProjectionsAndShiftsThatThereAreNot) {
  const auto reported = [](const std::string& keys) {
    return document::failure_of([&] {
      compiled(R"({"frames": 9, "models": {}, "actors": [], "camera": {"eye": [3, -4, 12], )" + keys + "}}");
    });
  };
  EXPECT_TRUE(document::holds(reported(R"("projection": "orthografic")"), "did you mean 'orthographic'?"));
  EXPECT_TRUE(document::holds(reported(R"("shift": [0, 1.5])"), "camera.shift[1]"));
  EXPECT_TRUE(document::holds(reported(R"("shift": 0.5)"), "camera.shift"));
  EXPECT_TRUE(document::holds(reported(R"("projection": "orthographic", "height": 0)"), "camera.height"));
}

TEST(Compile, RefusesACameraThatCannotLook) {
  const auto reported = [](const std::string& camera) {
    return document::failure_of(
        [&] { compiled(R"({"frames": 9, "models": {}, "actors": [], "camera": )" + camera + "}"); });
  };
  EXPECT_TRUE(document::holds(reported(R"({"eye": [0, 0, 0]})"), "camera, frame 0: has its eye where it looks at"));
  EXPECT_TRUE(document::holds(reported(R"({"eye": [0, 0, 5]})"), "looks along its up vector"));
  const std::string through = R"({"keys": [{"frame": 0, "eye": [-4, 0, 0]}, {"frame": 8, "eye": [4, 0, 0]}]})";
  EXPECT_TRUE(document::holds(reported(through), "frame 4"));
}

TEST(Compile, LightsTurnOnTheGreatCircle) {
  const CompiledFilm film = compiled(R"({"frames": 11, "models": {}, "actors": [], "camera": {"eye": [0, 9, 0]},
      "lights": [{"keys": [{"frame": 0, "direction": [1, 0, 0]}, {"frame": 10, "direction": [-1, 0, 0]}]}]})");
  const wire::PackedFilm view = film.view();
  for (std::uint32_t frame = 0; frame <= 10; ++frame) {
    const wire::Light& light = view.lights()[view.value_at(view.light_tracks()[0], frame)];
    EXPECT_NEAR(light.vector[0], std::cos(frame * std::acos(-1.0) / 10), 1e-6);
    EXPECT_NEAR(std::hypot(light.vector[0], light.vector[1], light.vector[2]), 1, 1e-6);
  }
}

TEST(Compile, OvershootKeepsMaterialsWithinWhatTheyCanBe) {
  const CompiledFilm film = compiled(R"({"frames": 20, "camera": {"eye": [0, 9, 0]},
      "materials": {"m": {"keys": [{"frame": 0, "color": [0, 0, 0], "exponent": 1, "ease": [0.5, -3, 0.5, 4]},
                                   {"frame": 19, "color": [1, 1, 1], "exponent": 0}]}},
      "models": {"b": {"joints": [{"name": "b", "segment": {"shape": "box", "material": "m"}}]}},
      "actors": [{"name": "b", "model": "b"}]})");
  for (const wire::Material& material : film.view().materials()) {
    EXPECT_GE(material.color[0], 0);
    EXPECT_LE(material.color[0], 1);
    EXPECT_GE(material.exponent, 0);
  }
  EXPECT_NO_THROW(wire::PackedFilm(film.block(), "f"));
}

std::string matrix_text(const modeler::Axes& frame) {
  std::string text = "[";
  for (int row = 0; row < 3; ++row) {
    char line[160];
    std::snprintf(line, sizeof line, "%s[%.17g, %.17g, %.17g, %.17g]", row ? ", " : "", frame.turn[0][row],
                  frame.turn[1][row], frame.turn[2][row], frame.place[row]);
    text += line;
  }
  return text + "]";
}

TEST(Compile, RawMatricesEqualAKeyedFilm) {
  const std::string keyed = arm_film(R"({"name": "x", "model": "arm", "keys": [
      {"frame": 0, "place": [0, 0, 0], "pose": {"a": [0, 0, 0], "b": [0, 0, 0]}, "ease": "both"},
      {"frame": 7, "pose": {"a": [10, 100, -50], "b": [0, 370, 0]}},
      {"frame": 19, "place": [1, 2, 3], "pose": {"a": [180, 0, 0]}}]})");
  const animator::Film film = film_of(keyed);
  animator::Figure figure(film.models[0], film.actors[0].motion);
  std::string matrices;
  for (std::uint32_t frame = 0; frame < film.frames; ++frame) {
    figure.move_to(frame);
    matrices += (frame ? ", " : "") + ("{\"frame\": " + std::to_string(frame)) + ", \"segments\": {";
    for (std::size_t joint = 0; joint < 2; ++joint)
      matrices += (joint ? ", \"b\": " : "\"a\": ") +
                  matrix_text(modeler::segment_frame(figure.frame_of(joint), film.models[0].joints[joint]));
    matrices += "}}";
  }
  const CompiledFilm one = compile(film);
  const CompiledFilm other = compiled(arm_film(R"({"name": "x", "model": "arm", "matrices": [)" + matrices + "]}"));
  for (std::size_t segment = 0; segment < 2; ++segment)
    for (std::uint32_t frame = 0; frame < film.frames; ++frame)
      EXPECT_EQ(one.view().matrix_at(one.view().segments()[segment], frame),
                other.view().matrix_at(other.view().segments()[segment], frame));
}

TEST(Compile, SizeMayBeChosenAgainstTheFilm) {
  EXPECT_EQ(compiled(arm_film(""), {{}, {{7680, 4320}}}).view().settings().width, 7680u);
  EXPECT_TRUE(document::holds(document::failure_of([] {
                                compiled(arm_film(""), {{}, {{0, 5}}});
                              }),
                              "1 to 16384 pixels"));
}

TEST(Compile, PlacesThatAddUpTooFarAreRefused) {
  std::string joints = R"({"name": "j0"})";
  for (int i = 1; i < 2000; ++i)
    joints += ", {\"name\": \"j" + std::to_string(i) + "\", \"parent\": \"j" + std::to_string(i - 1) +
              "\", \"place\": [1e9, 0, 0], \"segment\": {\"shape\": \"box\"}}";
  const std::string film = R"({"frames": 1, "camera": {"eye": [0, 9, 0]}, "models": {"m": {"joints": [)" + joints +
                           R"(]}}, "actors": [{"name": "x", "model": "m"}]})";
  EXPECT_TRUE(document::holds(document::failure_of([&] { compiled(film); }), "x/j1001, frame 0: stands farther"));
}

}  // namespace
}  // namespace mars::film
