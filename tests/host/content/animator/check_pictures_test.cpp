// Remarks about a film's pictures: shadows that are lost or stand off, and places that are not drawn.
#include "host/content/animator/pose/check_pictures.h"

#include <gtest/gtest.h>

#include "host/content/animator/pose/check.h"
#include "host/content/animator/reading/read_film.h"
#include "tests/host/content/document/failure_of.h"

namespace mars::animator {
namespace {

std::vector<std::string> lines_of_shadows(const std::string& light) {
  const std::string json =
      R"({"frames": 2, "camera": {"eye": [0, -9, 2]}, "lights": [{"direction": [0, 0, 1]}, )" + light + R"(],
      "materials": {"tin": {"interpolation": "flat"}, "unused": {"interpolation": "flat"}, "oak": {},
                    "sky": {"interpolation": "gouraud", "receives": false}},
      "models": {"m": {"materials": {"fur": {"interpolation": "gouraud"}, "skin": {"interpolation": "flat"}},
          "joints": [{"name": "a", "segment": {"shape": "box", "material": "fur"}},
                     {"name": "b", "segment": {"shape": "box", "material": "tin"}},
                     {"name": "c", "segment": {"shape": "box", "material": "skin"}},
                     {"name": "d", "segment": {"shape": "box", "material": "sky"}},
                     {"name": "e", "segment": {"shape": "box"}}]}},
      "actors": [{"name": "tom", "model": "m", "materials": {"skin": "oak"}},
                 {"name": "ann", "model": "m", "material": "tin"}]})";
  const document::Document document(json, "f.json");
  return check_film(read_film(document.root(), {})).lines;
}

TEST(Check, TellsOnWhatNoShadowFalls) {
  const std::vector<std::string> lines = lines_of_shadows(R"({"place": [0, 0, 9], "shadow": true})");
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0],
            "actor 'tom', material 'fur': no shadow falls on it, because its interpolation is gouraud (make "
            "that phong, or set receives=false)");
  EXPECT_TRUE(lines[1].starts_with("material/tin: ")) << lines[1];
  EXPECT_EQ(lines_of_shadows(R"({"place": [0, 0, 9]})"), std::vector<std::string>{});
}

TEST(Check, TellsOfASizeWithoutShadow) {
  const std::string line = "light/2: its size has no effect, because it casts no shadows (set shadow=true, or size=0)";
  EXPECT_EQ(lines_of_shadows(R"({"place": [0, 0, 9], "size": 1})"), std::vector<std::string>{line});
  EXPECT_EQ(lines_of_shadows(R"({"place": [0, 0, 9], "keys": [{"frame": 1, "size": 1}]})"),
            std::vector<std::string>{line});
  EXPECT_EQ(lines_of_shadows(R"({"place": [0, 0, 9], "size": 0})"), std::vector<std::string>{});
}

std::vector<std::string> lines_of_film_by(const std::string& camera, bool shadow) {
  const std::string json = R"({"frames": 2, "camera": {)" + camera +
                           R"(}, "lights": [{"direction": [0, 0, 1], "shadow": )" + (shadow ? "true" : "false") + R"(}],
      "models": {"m": {"joints": [{"name": "a", "segment": {"shape": "box"}}]}},
      "actors": [{"name": "tom", "model": "m"}]})";
  const document::Document document(json, "f.json");
  const Film film = read_film(document.root(), {});
  std::vector<std::string> lines = check_film(film).lines, warnings = warnings_of(film);
  for (std::string& line : lines) line = "f.json: " + line;
  EXPECT_EQ(lines, warnings);
  return lines;
}

// A camera that looks at what is `away`.
std::vector<std::string> lines_of_camera(double away, const std::string& camera, bool shadow = true) {
  return lines_of_film_by(R"("eye": [0, )" + std::to_string(-away) + R"(, 0], "at": [0, 0, 0])" + camera, shadow);
}

// By w * w / (2^23 near), docs/light-and-materials.md.
TEST(Check, TellsOfShadowsThatStandOffInMillimetres) {
  const std::vector<std::string> lines = lines_of_camera(10000, "");
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0],
            "f.json: camera: shadows begin 120 away from what casts them where it looks in frame 0, 10000 away: its "
            "near is 0.1 (fix it with: mars film f.json camera near=10)");
  EXPECT_EQ(lines_of_camera(10000, R"(, "near": 10)"), std::vector<std::string>{});
  EXPECT_EQ(lines_of_camera(10000, "", false), std::vector<std::string>{}) << "no light casts";
  EXPECT_EQ(lines_of_camera(10, ""), std::vector<std::string>{}) << "metres";
}

// A thousandth of the distance is too near for a picture that is so narrow.
TEST(Check, TellsANearPlaneThatHelpsThroughATelephotoLens) {
  const std::vector<std::string> lines = lines_of_camera(10000, R"(, "fov": 0.1, "near": 10)");
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_TRUE(document::holds(lines[0], "its near is 10 (fix it with: mars film f.json camera near=550)")) << lines[0];
  EXPECT_EQ(lines_of_camera(10000, R"(, "fov": 0.1, "near": 550)"), std::vector<std::string>{});
}

TEST(Check, TellsANearPlaneThatShowsAllThatTheCameraLooksAt) {
  const std::string looks =
      R"("eye": [0, 0, 0], "keys": [{"frame": 0, "at": [0, 1, 0]}, {"frame": 1, "at": [0, 10000, 0]}], "near": )";
  const std::vector<std::string> lines = lines_of_film_by(looks + "0.1", true);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_TRUE(document::holds(lines[0], "camera near=0.5)")) << lines[0];
  EXPECT_EQ(lines_of_film_by(looks + "0.5", true), std::vector<std::string>{}) << "no plane is better";
}

TEST(Check, TellsOfParallelShadowsThatStandOffInKilometres) {
  const std::string flat = R"(, "projection": "orthographic", "height": 0.02)";
  const std::vector<std::string> lines = lines_of_camera(0.2, flat);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_TRUE(document::holds(lines[0], "its far is 10000 (fix it with: mars film f.json camera far=2)")) << lines[0];
  EXPECT_EQ(lines_of_camera(0.2, flat + R"(, "far": 2)"), std::vector<std::string>{});
}

TEST(Check, TellsOfWhatTheCameraLooksAtAndDoesNotShow) {
  const std::vector<std::string> near = lines_of_camera(0.02, "", false);
  ASSERT_EQ(near.size(), 1u);
  EXPECT_EQ(near[0],
            "f.json: camera: nothing is drawn where it looks in frame 0, 0.02 away: its near is 0.1 (fix it with: mars "
            "film f.json camera near=2e-05)");
  const std::vector<std::string> far = lines_of_camera(20000, "", false);
  ASSERT_EQ(far.size(), 1u);
  EXPECT_TRUE(document::holds(far[0], "20000 away: its far is 10000 (fix it with: mars film f.json camera far=200000)"))
      << far[0];
}

}  // namespace
}  // namespace mars::animator
