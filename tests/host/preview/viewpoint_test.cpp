// Where the viewer stands and what it then sees.
#include "host/preview/viewpoint.h"

#include <gtest/gtest.h>

#include <cstring>
#include <glm/geometric.hpp>

#include "host/content/animator/reading/read_film.h"
#include "host/content/modeler/read_model.h"
#include "host/preview/film_pictures.h"

namespace mars::preview {
namespace {

// In the eye's frame: x to the right, y up, -z ahead.
glm::dvec3 seen(const wire::Camera& camera, const glm::dvec3& place) {
  glm::dvec3 at;
  for (int r = 0; r < 3; ++r) {
    const auto& row = camera.world_to_eye.m[static_cast<std::size_t>(r)];
    at[r] = row[0] * place.x + row[1] * place.y + row[2] * place.z + row[3];
  }
  return at;
}

void expect_same_place(const glm::dvec3& is, const glm::dvec3& should) { EXPECT_LT(glm::length(is - should), 1e-9); }

const Ball kBall{{1, 2, 3}, 2};

TEST(Viewpoint, FrontSideAndTop) {
  const auto from = [](From which, const glm::dvec3& offset) {
    const Orbit orbit = orbit_from(which, kBall, 1.5);
    return seen(camera_of(orbit), kBall.center + offset) + glm::dvec3(0, 0, orbit.distance);
  };
  expect_same_place(from(From::front, {1, 0, 0}), {0, 0, 1});  // towards the eye
  expect_same_place(from(From::front, {0, 1, 0}), {1, 0, 0});  // its left hand is to the right
  expect_same_place(from(From::front, {0, 0, 1}), {0, 1, 0});
  expect_same_place(from(From::side, {1, 0, 0}), {1, 0, 0});
  expect_same_place(from(From::side, {0, 0, 1}), {0, 1, 0});
  expect_same_place(from(From::top, {1, 0, 0}), {1, 0, 0});
  expect_same_place(from(From::top, {0, 1, 0}), {0, 1, 0});
}

TEST(Viewpoint, TheSubjectFillsThePictureAndNoMore) {
  for (const double aspect : {0.5, 1.0, 2.0}) {
    const Orbit orbit = orbit_from(From::front, kBall, aspect);
    const wire::Camera camera = camera_of(orbit);
    // The ball's outline, of half the angle asin(r / d), in units of half the picture's shorter side.
    const double angle = std::asin(kBall.radius / orbit.distance);
    const double part = camera.focal * std::tan(angle) / std::min(1.0, aspect);
    EXPECT_LT(part, 1);
    EXPECT_GT(part, 0.85);
  }
}

TEST(Viewpoint, TurningBeginsWhereTheCameraStands) {
  Orbit orbit{kBall.center, 33, 21, 17};
  const Orbit near = orbit_near(camera_of(orbit), kBall);
  expect_same_place(near.center, orbit.center);
  EXPECT_NEAR(near.turn, 33, 1e-9);
  EXPECT_NEAR(near.height, 21, 1e-9);
  EXPECT_NEAR(near.distance, 17, 1e-9);
}

// Of a camera that looks past the subject, too: the same direction from the same place, through the same lens.
TEST(Viewpoint, TurningBeginsWithWhatTheCameraShows) {
  const Orbit past{{-1, 4, 2}, 33, 21, 17};
  const wire::Camera camera = camera_of(past), again = camera_of(orbit_near(camera, kBall));
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 4; ++column)
      EXPECT_NEAR(again.world_to_eye.m[row][column], camera.world_to_eye.m[row][column], 1e-9) << row << column;
}

constexpr const char* kCameraFilm = R"({
  "frames": 3, "camera": {"keys": [{"frame": 0, "eye": [0, -6, 3]}, {"frame": 2, "eye": [4, -6, 3]}], "at": [0, 0, 0]},
  "models": {"box": {"joints": [{"name": "side", "segment": {"shape": "box"}}]}},
  "actors": [{"name": "box", "model": "box", "keys": [{"frame": 0}, {"frame": 2, "turn": [0, 0, 90]}]}]
})";

TEST(Turntable, LightsStandAsTheCameraSeesThem) {
  const std::string text = R"({"joints": [{"name": "ball", "segment": {"shape": "sphere"}}]})";
  const document::Document document(text, "ball");
  const animator::Film film = turntable(modeler::read_model(document.root()), "ball");
  ASSERT_EQ(film.lights.size(), 3u);
  const film::CompiledFilm compiled = film::compile(film);
  const wire::PackedFilm view = compiled.view();
  for (const std::uint32_t frame : {0u, 31u, 95u}) {
    const auto before = [&](std::size_t light) {  // the camera, that is
      const wire::Light& each = view.lights()[view.value_at(view.light_tracks()[light], frame)];
      const auto& out = view.camera_at(frame).world_to_eye.m[2];
      return out[0] * each.vector[0] + out[1] * each.vector[1] + out[2] * each.vector[2] > 0;
    };
    EXPECT_TRUE(before(0)) << "the key light";
    EXPECT_TRUE(before(1)) << "the fill light";
    EXPECT_FALSE(before(2)) << "the rim light";
  }
}

TEST(AsSeen, AnotherCameraKeepsTheExposure) {
  const std::string text =
      std::string(kCameraFilm).replace(std::string(kCameraFilm).find("\"at\""), 4, "\"exposure\": 1, \"at\"");
  const film::CompiledFilm film = film::compile(animator::read_film(document::Document(text, "film").root(), {}));
  const wire::Camera camera = camera_of(orbit_from(From::top, kBall, 1));
  EXPECT_EQ(as_seen(film, {64, 36}, &camera).view().camera_at(1).exposure, 2);
}

TEST(AsSeen, AnotherCameraStandsStillAndOthersStay) {
  const animator::Film source = animator::read_film(document::Document(kCameraFilm, "film").root(), {});
  const film::CompiledFilm film = film::compile(source);
  const wire::Camera camera = camera_of(orbit_from(From::top, kBall, 1));
  const film::CompiledFilm other = as_seen(film, {64, 36}, &camera);
  wire::PackedFilm(other.block(), "seen");  // throws unless all is sound
  EXPECT_EQ(other.view().settings().width, 64u);
  for (std::uint32_t frame = 0; frame < 3; ++frame) EXPECT_EQ(other.view().camera_at(frame), camera);
  const film::CompiledFilm same = as_seen(film, {64, 36}, nullptr);
  for (std::uint32_t frame = 0; frame < 3; ++frame)
    EXPECT_EQ(same.view().camera_at(frame), film.view().camera_at(frame));
  EXPECT_EQ(
      std::memcmp(film.view().matrices().data(), other.view().matrices().data(), film.view().matrices().size_bytes()),
      0);
}

// Keeps what it is asked.
struct Asked : SurfaceSource {
  void aim(images::PictureSize, const std::optional<wire::Camera>& by, std::vector<std::uint32_t> wanted) override {
    ++aims;
    camera = by;
    frames = std::move(wanted);
  }
  SharedImage frame(std::uint32_t) override { return nullptr; }
  SharedImage wait_for(std::uint32_t) override { return nullptr; }

  int aims = 0;
  std::optional<wire::Camera> camera;
  std::vector<std::uint32_t> frames;
};

TEST(FilmPictures, KeysChangeWhatIsSeen) {
  const animator::Film source = animator::read_film(document::Document(kCameraFilm, "film").root(), {});
  const Wireframe wireframe = wireframe_of(film::compile(source), &source);
  Asked asked;
  FilmPictures pictures(wireframe, asked, {});
  const auto key = [&](char character) { return pictures.handle_key({character, Special::none}, 0); };
  EXPECT_EQ(pictures.state(), "prisms, camera");
  EXPECT_EQ(pictures.camera(2, 1), wireframe.camera_at(2));
  EXPECT_TRUE(key('1'));
  EXPECT_TRUE(key('t'));
  EXPECT_EQ(pictures.state(), "stick, top");
  EXPECT_EQ(pictures.camera(0, 2), camera_of(orbit_from(From::top, wireframe.subject, 2)));
  EXPECT_TRUE(pictures.handle_key({0, Special::left}, 0));
  EXPECT_EQ(pictures.state(), "stick, turned");
  EXPECT_TRUE(key('c'));
  EXPECT_TRUE(key('+'));
  EXPECT_GT(pictures.camera(0, 1).focal, wireframe.camera_at(0).focal);
  EXPECT_FALSE(key('x'));
}

TEST(FilmPictures, RendererIsAimedOnceAView) {
  const animator::Film source = animator::read_film(document::Document(kCameraFilm, "film").root(), {});
  const Wireframe wireframe = wireframe_of(film::compile(source), &source);
  Asked asked;
  FilmPictures pictures(wireframe, asked, {});
  pictures.handle_key({'4', Special::none}, 0);
  EXPECT_EQ(pictures.picture(1, {64, 36}), nullptr);
  EXPECT_FALSE(pictures.complete());
  EXPECT_EQ(asked.frames, (std::vector<std::uint32_t>{1, 2, 0}));
  EXPECT_FALSE(asked.camera.has_value());
  pictures.picture(2, {64, 36});
  EXPECT_EQ(asked.aims, 1);
  pictures.handle_key({'f', Special::none}, 0);
  pictures.picture(2, {64, 36});
  EXPECT_EQ(asked.aims, 2);
  EXPECT_TRUE(asked.camera.has_value());
  pictures.picture(2, {32, 18});
  EXPECT_EQ(asked.aims, 3);
  pictures.handle_key({'3', Special::none}, 0);
  EXPECT_NE(pictures.picture(2, {32, 18}), nullptr);
  EXPECT_TRUE(pictures.complete());
}

}  // namespace
}  // namespace mars::preview
