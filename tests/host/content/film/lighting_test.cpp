// Samples, colour spaces, light and materials: from a film file to what nodes read.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "host/content/animator/reading/rig.h"
#include "host/content/film/light_writer.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/host/content/film/small_film.h"

namespace mars::film {
namespace {

// A film of a ball, with `more` keys of its own and `material`.
std::string ball_film(const std::string& more, const std::string& material = "") {
  return R"({"frames": 12, "camera": {"eye": [0, -9, 0]}, "materials": {"m": {)" + material + R"(}}, "models": {"b": {
      "joints": [{"name": "b", "segment": {"shape": "sphere", "material": "m"}}]}},
      "actors": [{"name": "b", "model": "b"}])" +
         (more.empty() ? "" : ", " + more) + "}";
}

std::string lit(const std::string& light) { return ball_film("\"lights\": [{" + light + "}]"); }

std::string refusal(const std::string& json) {
  return document::failure_of([&] { compiled(json); });
}

wire::Light light_at(const CompiledFilm& film, std::uint32_t frame, std::size_t light = 0) {
  const wire::PackedFilm view = film.view();
  return view.lights()[view.value_at(view.light_tracks()[light], frame)];
}

wire::Material material_of(const std::string& material) {
  const CompiledFilm film = compiled(ball_film("", material));
  return film.view().material_at(film.view().segments()[0], 0);
}

TEST(Lighting, AFilmIsLinearWithFourSamplesUnlessItSaysOtherwise) {
  const wire::FilmSettings usual = compiled(ball_film("")).view().settings();
  EXPECT_EQ(usual.samples, 4u);
  EXPECT_EQ(usual.color_space, wire::ColorSpace::linear);
  EXPECT_EQ(usual.curve, wire::Curve::filmic);
  EXPECT_EQ(usual.fog, wire::Fog());
  const wire::FilmSettings other = compiled(ball_film(R"("color": "coded", "samples": 16)")).view().settings();
  EXPECT_EQ(other.samples, 16u);
  EXPECT_EQ(other.color_space, wire::ColorSpace::coded);
  EXPECT_EQ(other.curve, wire::Curve::none);
  EXPECT_EQ(compiled(ball_film(R"("curve": "none")")).view().settings().curve, wire::Curve::none);
}

TEST(Lighting, ColoursBecomeLightInLinearFilmsOnly) {
  const std::string more = R"(, "background": [0.5, 0, 1], "ambient": {"sky": [0.5, 1, 1], "ground": [0, 0.5, 0]},
      "fog": {"color": [0.5, 0.5, 0], "start": 2, "end": 7}, "lights": [{"direction": [0, 0, 1], "color": [0.5, 1, 0],
      "intensity": 3}])";
  const float half = 0.21404114f;  // sRGB's 0.5
  for (const bool linear : {false, true}) {
    const CompiledFilm film = compiled(
        ball_film((linear ? R"("color": "linear")" : R"("color": "coded")") + more, R"("color": [0.5, 0, 1])"));
    const wire::FilmSettings& settings = film.view().settings();
    const float is = linear ? half : 0.5f;
    EXPECT_FLOAT_EQ(settings.background[0], is);
    EXPECT_FLOAT_EQ(settings.ambient.sky[0], is);
    EXPECT_FLOAT_EQ(settings.ambient.ground[1], is);
    EXPECT_FLOAT_EQ(settings.fog.color[1], is);
    EXPECT_EQ(settings.fog.start, 2);
    EXPECT_EQ(settings.fog.end, 7);
    EXPECT_FLOAT_EQ(light_at(film, 0).color[0], 3 * is);
    EXPECT_EQ(light_at(film, 0).color[1], 3);
    EXPECT_FLOAT_EQ(film.view().materials()[0].color[0], is);
    EXPECT_EQ(film.view().materials()[0].color[2], 1);
  }
}

TEST(Lighting, LightIsShownAsTheColourItWas) {
  for (int step = 0; step <= 255; ++step) {
    const double shown = step / 255.0;
    EXPECT_NEAR(shown_of(light_of({shown, 0, 0}, wire::ColorSpace::linear), wire::ColorSpace::linear)[0], shown, 1e-6);
    EXPECT_EQ(shown_of(light_of({shown, 0, 0}, wire::ColorSpace::coded), wire::ColorSpace::coded)[0], float(shown));
  }
  EXPECT_NEAR(light_of({0.02, 0, 0}, wire::ColorSpace::linear)[0], 0.02 / 12.92, 1e-9) << "IEC 61966-2-1";
}

TEST(Lighting, AModelsOwnMaterialBecomesLightToo) {
  const CompiledFilm film = compiled(R"({"frames": 1, "camera": {"eye": [0, -9, 0]}, "models": {"b": {
      "materials": {"tin": {"color": [0.5, 0.5, 0.5], "reflection": "metallic-roughness", "metallic": 1,
                            "roughness": 0.25, "interpolation": "flat"}},
      "joints": [{"name": "b", "segment": {"shape": "box", "material": "tin"}}]}},
      "actors": [{"name": "b", "model": "b"}]})");
  const wire::Material& tin = film.view().materials()[0];
  EXPECT_FLOAT_EQ(tin.color[0], 0.21404114f);
  EXPECT_EQ(tin.reflection, wire::Reflection::metallic_roughness);
  EXPECT_EQ(tin.interpolation, wire::Interpolation::flat);
  EXPECT_EQ(tin.metallic, 1);
  EXPECT_EQ(tin.roughness, 0.25f);
}

TEST(Lighting, MaterialsTakeEveryModelsKeys) {
  EXPECT_EQ(material_of(R"("interpolation": "gouraud")").interpolation, wire::Interpolation::gouraud);
  EXPECT_EQ(material_of(R"("reflection": "blinn-phong", "exponent": 9)").exponent, 9);
  const wire::Material stone = material_of(R"("reflection": "cook-torrance", "roughness": 0.3, "refraction": 2)");
  EXPECT_EQ(stone.reflection, wire::Reflection::cook_torrance);
  EXPECT_EQ(stone.roughness, 0.3f);
  EXPECT_EQ(stone.refraction, 2);
  EXPECT_EQ(material_of("").reflection, wire::Reflection::phong);
}

TEST(Lighting, RefusesWhatAReflectionDoesNotUse) {
  const auto refused = [](const std::string& material) { return refusal(ball_film("", material)); };
  EXPECT_TRUE(document::holds(refused(R"("roughness": 0.5)"),
                              "materials.m.roughness: is not used by the reflection 'phong' (leave it out, or choose a "
                              "reflection that uses it: cook-torrance, metallic-roughness)"));
  EXPECT_TRUE(document::holds(refused(R"("reflection": "metallic-roughness", "exponent": 5)"), "phong, blinn-phong"));
  EXPECT_TRUE(document::holds(refused(R"("reflection": "cook-torrance", "metallic": 1)"), "'cook-torrance'"));
  EXPECT_TRUE(
      document::holds(refused(R"("keys": [{"frame": 0, "refraction": 2}])"), "keys[0].refraction: is not used"));
  EXPECT_TRUE(document::holds(refused(R"("reflection": "blin-phong")"), "did you mean 'blinn-phong'?"));
  EXPECT_TRUE(document::holds(refused(R"("interpolation": "smooth")"), "choose one of: phong, gouraud, flat"));
  EXPECT_TRUE(document::holds(refused(R"("reflection": "cook-torrance", "refraction": 1)"), "from 1.01 to 100"));
  EXPECT_TRUE(document::holds(refused(R"("reflection": "cook-torrance", "roughness": 2)"), "from 0 to 1"));
}

TEST(Lighting, RefusesSettingsThatDoNotFit) {
  const auto refused = [](const std::string& more) { return refusal(ball_film(more)); };
  EXPECT_TRUE(document::holds(refused(R"("samples": 3)"), "samples: is 3 (write 1, 2, 4, 8 or 16)"));
  EXPECT_TRUE(document::holds(refused(R"("samples": 32)"), "samples: is 32 (write 1, 2, 4, 8 or 16)"));
  EXPECT_TRUE(document::holds(refused(R"("color": "liner")"), "did you mean 'linear'?"));
  EXPECT_TRUE(document::holds(refused(R"("color": [1, 1, 1])"), R"(write "color": "linear")"));
  EXPECT_TRUE(document::holds(refused(R"("color": "coded", "curve": "filmic")"), "colours are coded"));
  EXPECT_TRUE(document::holds(refused(R"("ambient": 0.2)"), R"(write "ambient": [0.8, 0.9, 1])"));
  EXPECT_TRUE(document::holds(refused(R"("ambient": {"sky": [1, 1, 1]})"), "has no 'ground'"));
  EXPECT_TRUE(document::holds(refused(R"("fog": {"start": 5, "end": 5})"), "not beyond its start"));
  EXPECT_TRUE(document::holds(refused(R"("fog": {"start": 5})"), "has no 'end'"));
  EXPECT_TRUE(document::holds(refused(R"("fgo": {"end": 5})"), "did you mean 'fog'?"));
  EXPECT_TRUE(document::holds(
      refusal(
          R"({"frames": 1, "color": "coded", "camera": {"eye": [0, 9, 0], "exposure": 1}, "models": {}, "actors": []})"),
      "camera: has an exposure, but the film's colours are coded"));
  CompileOptions options;
  options.samples = 5;
  EXPECT_TRUE(document::holds(document::failure_of([&] { compiled(ball_film(""), options); }), "1, 2, 4, 8 or 16"));
}

TEST(Lighting, ASpotAimsAndOpensByHalfItsCone) {
  const wire::Light spot =
      light_at(compiled(lit(R"("place": [0, 0, 5], "at": [0, 3, 1], "cone": [60, 90], "reach": 4)")), 0);
  EXPECT_EQ(spot.kind, wire::LightKind::spot);
  EXPECT_EQ(spot.vector, (std::array{0.0f, 0.0f, 5.0f}));
  EXPECT_FLOAT_EQ(spot.axis[1], 0.6f);
  EXPECT_FLOAT_EQ(spot.axis[2], -0.8f);
  EXPECT_FLOAT_EQ(spot.cos_inner, std::cos(std::acos(-1.0f) / 6));
  EXPECT_FLOAT_EQ(spot.cos_outer, std::sqrt(0.5f));
  EXPECT_EQ(spot.reach, 4);
  const wire::Light one = light_at(compiled(lit(R"("place": [0, 0, 5], "at": [0, 0, 0], "cone": 90)")), 0);
  EXPECT_EQ(one.cos_outer, spot.cos_outer);
  EXPECT_FLOAT_EQ(one.cos_inner, std::cos(std::acos(-1.0f) / 5)) << "0.8 of it";
  EXPECT_EQ(one.reach, 0) << "does not fall off";
  const wire::Light point = light_at(compiled(lit(R"("place": [0, 0, 5], "reach": 2)")), 0);
  EXPECT_EQ(point.kind, wire::LightKind::point);
  EXPECT_EQ(point.reach, 2);
}

TEST(Lighting, ALightCastsWhereItSaysSo) {
  const wire::Light plain = light_at(compiled(lit(R"("direction": [0, 0, 1], "size": 10)")), 0);
  EXPECT_EQ(plain.casts, 0u);
  EXPECT_EQ(plain.size, 0) << "which nothing would show";
  const wire::Light sharp = light_at(compiled(lit(R"("direction": [0, 0, 1], "shadow": true)")), 0);
  EXPECT_EQ(sharp.casts, 1u);
  EXPECT_EQ(sharp.size, 0);
  const wire::Light sun = light_at(compiled(lit(R"("direction": [0, 0, 1], "shadow": true, "size": 90)")), 0);
  EXPECT_FLOAT_EQ(sun.size, 1) << "the tangent of half the angle";
  for (const char* aim : {"", R"(, "at": [0, 0, 1])"}) {
    const std::string near = R"("place": [0, 0, 5], "shadow": true, "size": 120)";
    EXPECT_EQ(light_at(compiled(lit(near + aim)), 0).size, 60) << "a radius" << aim;
  }
}

TEST(Lighting, ALightsSizeMayChange) {
  const CompiledFilm film = compiled(lit(R"("place": [0, 0, 5], "shadow": true, "keys": [
      {"frame": 2, "size": 0}, {"frame": 4, "size": 4}])"));
  for (const auto& [frame, radius] : std::map<std::uint32_t, float>{{2, 0}, {3, 1}, {4, 2}, {11, 2}})
    EXPECT_EQ(light_at(film, frame).size, radius) << frame;
  const CompiledFilm unseen = compiled(lit(R"("place": [0, 0, 5], "keys": [
      {"frame": 2, "size": 0}, {"frame": 4, "size": 4}])"));
  EXPECT_EQ(unseen.view().lights().size(), 1u);
}

TEST(Lighting, MaterialsCastAndReceiveUnlessTheySayOtherwise) {
  EXPECT_EQ(material_of("").casts, 1u);
  EXPECT_EQ(material_of("").receives, 1u);
  EXPECT_EQ(material_of(R"("casts": false)").casts, 0u);
  EXPECT_EQ(material_of(R"("receives": false, "keys": [{"frame": 0, "ambient": 0}])").receives, 0u);
  const CompiledFilm own = compiled(R"({"frames": 1, "camera": {"eye": [0, -9, 0]}, "models": {"b": {
      "materials": {"glass": {"casts": false}, "sky": {"receives": false}},
      "joints": [{"name": "b", "segment": {"shape": "box", "material": "glass"}},
                 {"name": "c", "segment": {"shape": "box", "material": "sky"}}]}},
      "actors": [{"name": "b", "model": "b"}]})");
  EXPECT_EQ(own.view().materials()[0].casts, 0u);
  EXPECT_EQ(own.view().materials()[0].receives, 1u);
  EXPECT_EQ(own.view().materials()[1].receives, 0u);
}

TEST(Lighting, RefusesShadowsThatMakeNoSense) {
  const auto refused = [](const std::string& light) { return refusal(lit(light)); };
  EXPECT_TRUE(
      document::holds(refused(R"("direction": [0, 0, 1], "size": 91)"), "size: is 91 (write a number from 0 to 90)"));
  EXPECT_TRUE(
      document::holds(refused(R"("place": [0, 0, 1], "keys": [{"frame": 0, "size": -1}])"), "keys[0].size: is -1"));
  EXPECT_EQ(refused(R"("place": [0, 0, 1], "size": 91)"), "");
  EXPECT_TRUE(document::holds(refused(R"("direction": [0, 0, 1], "shadow": 1)"), "lights[0].shadow: is a number"));
  EXPECT_TRUE(document::holds(refused(R"("place": [0, 0, 1], "keys": [{"frame": 0, "shadow": true}])"),
                              "keys[0].shadow: does not belong to a key of a light"));
  EXPECT_TRUE(document::holds(refusal(ball_film("", R"("casts": "no")")), "materials.m.casts: is a text"));
}

TEST(Lighting, RefusesLightsThatMakeNoSense) {
  const auto refused = [](const std::string& light) { return refusal(lit(light)); };
  EXPECT_TRUE(document::holds(refused(R"("direction": [0, 0, 1], "at": [0, 0, 0])"), "for a spot give place and at"));
  EXPECT_TRUE(document::holds(refused(R"("at": [0, 0, 0])"), "neither a direction nor a place"));
  EXPECT_TRUE(document::holds(refused(R"("place": [0, 0, 1], "cone": 30)"), "is a point light and has a cone"));
  EXPECT_TRUE(document::holds(refused(R"("direction": [0, 0, 1], "reach": 3)"), "leave reach out"));
  EXPECT_TRUE(document::holds(refused(R"("place": [0, 0, 1], "reach": 0)"), "from 1e-06"));
  EXPECT_TRUE(document::holds(refused(R"("place": [0, 0, 1], "at": [0, 0, 0], "cone": [40, 30])"),
                              "write the inner angle first"));
  EXPECT_TRUE(document::holds(refused(R"("place": [0, 0, 1], "at": [0, 0, 0], "cone": 200)"), "from 0.01 to 180"));
  EXPECT_EQ(refused(R"("keys": [{"frame": 0, "place": [0, 0, 0]}, {"frame": 8, "place": [0, 0, 2]}], "at": [0, 0, 1])"),
            "f.json: lights[0], frame 4: has its place where it shines at (move place or at)");
}

// One clear error with file, line and remedy; nothing of the kind comes to a node.
TEST(Lighting, RefusesEndlessLight) {
  EXPECT_EQ(refusal("{\"frames\": 1,\n\"lights\": [{\"direction\": [0, 0, 1],\n\"intensity\": 1e9}],"
                    "\"camera\": {\"eye\": [0, 9, 0]}, \"models\": {}, \"actors\": []}"),
            "f.json:3: lights[0].intensity: is 1e+09 (write a number from 0 to 1000)");
  EXPECT_TRUE(
      document::holds(refusal(lit(R"("direction": [0, 0, 1], "color": [1e9, 0, 0])")), "lights[0].color[0]: is"));
  for (const char* number : {"NaN", "Infinity", "1e999"}) {
    const std::string said = refusal(lit(std::string(R"("direction": [0, 0, 1], "intensity": )") + number));
    EXPECT_TRUE(document::holds(said, "f.json:")) << said;
    EXPECT_TRUE(document::holds(said, "(")) << said;
  }
}

TEST(Lighting, OvershootStaysWithinWhatNodesTake) {
  const std::string swing = R"("ease": [0.5, -10, 0.5, 10])";
  const CompiledFilm film = compiled(ball_film(
      R"("lights": [{"place": [0, 0, 5], "keys": [
          {"frame": 0, "intensity": 0, "color": [0, 0, 0], "reach": 1, "at": [0, 0, 0], "cone": [1, 1], "size": 0, )" +
          swing +
          R"(}, {"frame": 11, "intensity": 1000, "color": [1, 1, 1], "reach": 9, "at": [0, 0, 1], "cone": [170, 180],
           "size": 1e9}], "shadow": true}])",
      R"("reflection": "cook-torrance", "keys": [{"frame": 0, "roughness": 0, "refraction": 1.01, )" + swing +
          R"(}, {"frame": 11, "roughness": 1, "refraction": 100}])"));
  EXPECT_NO_THROW(wire::PackedFilm(film.block(), "f"));
  EXPECT_GT(film.view().lights().size(), 5u) << "it swings";
  const CompiledFilm zoom =
      compiled(R"({"frames": 12, "models": {}, "actors": [], "camera": {"eye": [0, -9, 0], "keys": [
      {"frame": 0, "fov": 1, )" +
               swing + R"(}, {"frame": 11, "fov": 170}]}})");
  EXPECT_NO_THROW(wire::PackedFilm(zoom.block(), "f"));
  EXPECT_GT(zoom.view().cameras().size(), 3u) << "it swings";
}

std::string exposed_film(const std::string& cutting) {
  return R"({"frames": 9, "intervals": ")" + cutting + R"(", "camera": {"eye": [0, -9, 0], "keys": [
      {"frame": 2, "exposure": 0, "ease": [0.5, -10, 0.5, 10]}, {"frame": 5, "exposure": -1}, {"frame": 7, "exposure": -1}]},
      "models": {"b": {"joints": [{"name": "b", "segment": {"shape": "sphere"}}]}},
      "actors": [{"name": "b", "model": "b", "keys": [{"frame": 6, "place": [1, 0, 0]}]}]})";
}

TEST(Lighting, IntervalsBeginWhereTheExposureChanges) {
  const auto starts_of = [](const CompiledFilm& film) {
    std::vector<std::uint32_t> starts;
    for (const wire::Interval& interval : film.view().intervals()) starts.push_back(interval.first_frame);
    return starts;
  };
  const CompiledFilm automatic = compiled(exposed_film("auto")), keyed = compiled(exposed_film("keyframes"));
  EXPECT_EQ(starts_of(automatic), (std::vector<std::uint32_t>{0, 3, 4, 5}));
  EXPECT_EQ(starts_of(keyed), (std::vector<std::uint32_t>{0, 2, 3, 4, 5, 6, 7}));
  for (const CompiledFilm* film : {&automatic, &keyed}) {
    EXPECT_NO_THROW(wire::PackedFilm(film->block(), "f")) << "checks that it is the same throughout an interval";
    EXPECT_EQ(film->view().camera_at(0).exposure, 1);
    EXPECT_EQ(film->view().camera_at(8).exposure, 0.5);
  }
}

TEST(Lighting, SamplesCanBeChosenForEitherKindOfFile) {
  CompileOptions options;
  options.samples = 8;
  EXPECT_EQ(compiled(ball_film("\"samples\": 2"), options).view().settings().samples, 8u);
}

TEST(Lighting, AFilmWithoutLightsGetsARig) {
  for (const std::string space : {"linear", "coded"}) {
    const CompiledFilm film = compiled(ball_film("\"color\": \"" + space + "\""));
    ASSERT_EQ(film.view().light_tracks().size(), 3u);
    const wire::Light key = light_at(film, 0, 0), fill = light_at(film, 0, 1), rim = light_at(film, 0, 2);
    EXPECT_LT(key.vector[0], 0) << "from the left, the camera looking along y";
    EXPECT_LT(key.vector[1], 0) << "before";
    EXPECT_GT(key.vector[2], 0) << "above";
    EXPECT_GT(fill.vector[0], 0);
    EXPECT_GT(rim.vector[1], 0) << "behind";
    EXPECT_GT(key.color[0], key.color[2]) << "warm";
    EXPECT_LT(fill.color[0], fill.color[2]) << "cool";
    EXPECT_GT(key.color[0], 2 * fill.color[0]);
  }
  EXPECT_EQ(compiled(ball_film("\"lights\": []")).view().light_tracks().size(), 0u);
  EXPECT_EQ(compiled(ball_film("\"lights\": []")).view().settings().ambient, wire::AmbientLight());
  EXPECT_LT(compiled(ball_film("")).view().settings().ambient.ground[2], 0.9f);
  EXPECT_EQ(compiled(ball_film("\"ambient\": [0, 0, 0]")).view().settings().ambient.sky[0], 0);
}

TEST(Lighting, TheRigStandsAsTheFirstCameraSeesIt) {
  const auto there = animator::rig_directions({9, 0, 0}, {0, 0, 0}, {0, 0, 2});
  EXPECT_GT(there[0].x, 0) << "before a camera that looks along -x";
  EXPECT_LT(there[0].y, 0) << "its left";
  EXPECT_LT(there[2].x, 0);
  for (const glm::dvec3& direction : there) EXPECT_NEAR(glm::length(direction), 1, 1e-12);
  for (const glm::dvec3& direction : animator::rig_directions({0, 0, 5}, {0, 0, 5}, {0, 0, 0}))
    EXPECT_NEAR(glm::length(direction), 1, 1e-12) << "whatever a camera is refused for";
}

}  // namespace
}  // namespace mars::film
