// mars import --as film of glTF: through the film as it is compiled, joints and vertices are where glTF's formulas put
// them, by keys and by matrices; cameras and lights come along; what cannot be shown is reported.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "host/content/animator/pose/joint_frames.h"
#include "host/content/animator/reading/read_film.h"
#include "host/content/document/json_file.h"
#include "host/content/film/compile.h"
#include "host/content/modeler/bent_skin.h"
#include "host/content/modeler/frames.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/host/content/importer/glb.h"
#include "tests/host/content/importer/gltf/plain_gltf.h"
#include "tests/host/content/importer/import_folder.h"

namespace mars::importer {
namespace {

using document::failure_of;
using document::holds;
using document::Json;
using test::Glb;
using Places = std::vector<glm::dvec3>;

constexpr float kHalf = 0.70710678f;

// In MARS z is up.
glm::dvec3 upright(const glm::dvec3& place) { return {place.x, -place.z, place.y}; }

glm::dvec3 by(const wire::Matrix& matrix, const modeler::Mesh::Place& place) {
  glm::dvec3 moved;
  for (int row = 0; row < 3; ++row) {
    const auto& numbers = matrix.m[static_cast<std::size_t>(row)];
    moved[row] = numbers[0] * place[0] + numbers[1] * place[1] + numbers[2] * place[2] + numbers[3];
  }
  return moved;
}

// All vertices of the film's only actor as the compiled film has them.
Places vertices_of(const animator::Film& film, const wire::PackedFilm& compiled, std::uint32_t frame) {
  Places places;
  std::size_t number = 0;
  for (const modeler::Joint& joint : film.models[0].joints) {
    if (!joint.segment) continue;
    const modeler::Mesh& mesh = *film.models[0].shapes[joint.segment->shape].mesh;
    const wire::Segment& segment = compiled.segments()[number++];
    std::vector<wire::Matrix> bones;
    for (const wire::Track& bone : compiled.bones_of(segment)) bones.push_back(compiled.matrix_at(bone, frame));
    const modeler::BentSkin skin(bones, segment.blend);
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
      places.push_back(bones.empty() ? by(compiled.matrix_at(segment, frame), mesh.vertices[v])
                                     : skin.place_of(mesh.vertices[v], mesh.bones[v]));
  }
  return places;
}

double farthest_from(const Places& some, const Places& others) {
  double farthest = 0;
  for (const glm::dvec3& place : some) {
    double nearest = 1e9;
    for (const glm::dvec3& other : others) nearest = std::min(nearest, glm::distance(place, other));
    farthest = std::max(farthest, nearest);
  }
  return farthest;
}

class GltfFilms : public ImportFolder {
 protected:
  // Imported as a film; its report.
  std::string import(
      const std::string& bytes, const std::function<void(ImportOptions&)>& change = [](auto&) {}) {
    ImportOptions options = options_for(write("file.glb", bytes));
    options.as = ImportAs::film;
    change(options);
    const std::string report = import_model(options);
    film_ = animator::read_film(options.to);
    json_ = document::read_json(options.to);
    return report;
  }

  // Every vertex of every frame, within 1e-5 of the size of all that is seen.
  void expect_as_in_the_file(const std::string& bytes, std::size_t animation = 0) {
    const test::PlainGltf file(bytes);
    const film::CompiledFilm compiled = film::compile(film_);
    double worst = 0;
    glm::dvec3 least(1e9), greatest(-1e9);
    for (std::uint32_t frame = 0; frame < film_.frames; ++frame) {
      Places expected = file.vertices(frame / film_.rate, animation);
      for (glm::dvec3& place : expected) {
        place = upright(place);
        least = glm::min(least, place), greatest = glm::max(greatest, place);
      }
      const Places found = vertices_of(film_, compiled.view(), frame);
      worst = std::max({worst, farthest_from(expected, found), farthest_from(found, expected)});
    }
    EXPECT_LT(worst, 1e-5 * glm::length(greatest - least));
  }

  void expect_joint(const std::string& bytes, const std::string& name, std::size_t node, double error) {
    const auto& joints = film_.models[0].joints;
    const auto joint = std::ranges::find(joints, name, &modeler::Joint::name);
    ASSERT_NE(joint, joints.end()) << name;
    animator::JointFrames frames(film_);
    const test::PlainGltf file(bytes);
    for (std::uint32_t frame = 0; frame < film_.frames; ++frame) {
      const glm::dvec3 wanted = upright(glm::dvec3(file.nodes(frame / film_.rate)[node][3])),
                       found = frames.frame_of(0, static_cast<std::size_t>(joint - joints.begin()), frame).place;
      ASSERT_LT(glm::distance(wanted, found), error) << name << " at frame " << frame;
    }
  }

  const Json& actor() const { return json_.at("actors").at(0); }

  animator::Film film_;
  Json json_;
};

// A chain of three bones under a node that scales and turns, as in skins_test.cpp.
Glb figure() {
  Glb glb;
  const int joints = glb.bytes("VEC4", {0, 1, 2, 0, 0, 1, 0, 0, 1, 2, 0, 0}),
            weights = glb.floats("VEC4", {0.2f, 0.3f, 0.5f, 0, 0.9f, 0.1f, 0, 0, 0.4f, 0.6f, 0, 0});
  const int mesh = glb.triangle({0.3f, 0, 0.1f, 0.2f, 0.1f, 1.8f, -0.2f, 0.3f, 0.9f},
                                {{"JOINTS_0", joints}, {"WEIGHTS_0", weights}});
  const int inverse = glb.floats("MAT4", {1, 0, 0, 0, 0,  1, 0, 0, 0, 0, 1, 0, 0,    0,    -1,    1,  //
                                          0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0,    0.1f, -1.5f, 1,  //
                                          1, 0, 0, 0, 0,  1, 0, 0, 0, 0, 1, 0, 0.2f, 0,    -1.7f, 1});
  glb.json["nodes"] = {{{"name", "root"}, {"scale", {2, 2, 2}}, {"rotation", {-0.6, 0, 0, 0.8}}, {"children", {1, 2}}},
                       {{"name", "body"}, {"mesh", mesh}, {"skin", 0}, {"translation", {7, 8, 9}}},
                       {{"name", "hip"}, {"translation", {0, 0, 1}}, {"children", {3}}},
                       {{"name", "chest"},
                        {"translation", {0.1, 0, 0.5}},
                        {"rotation", {0, 0.6, 0, 0.8}},
                        {"scale", {0.5, 0.5, 0.5}},
                        {"children", {4}}},
                       {{"name", "head"}, {"translation", {0, 0.2, 0.8}}}};
  glb.json["skins"] = {{{"joints", {2, 3, 4}}, {"inverseBindMatrices", inverse}}};
  glb.json["animations"] = {{{"name", "walk"}}};
  return glb;
}

// The hips walk and sway, the chest follows a spline, the head turns in steps; places and scales that the animation
// gives, but never changes, are not the nodes' own.
Glb walking() {
  Glb glb = figure();
  glb.channel(0, 2, "translation", "LINEAR", {0, 0.5f, 1}, glb.floats("VEC3", {0, 0, 1, 1, 0.2f, 1.1f, 4, 0, 1}));
  glb.channel(0, 2, "rotation", "LINEAR", {0, 0.5f, 1},
              glb.floats("VEC4", {0, 0, 0, 1, 0.6f, 0, 0, -0.8f, 0, kHalf, 0, kHalf}));
  glb.channel(0, 3, "rotation", "CUBICSPLINE", {0.25f, 0.75f},
              glb.floats("VEC4", {0, 0, 0, 0, 0,    0.6f, 0,    0.8f, 1, -2, 0.5f, 0,  //
                                  3, 0, 1, 0, 0.5f, 0.5f, 0.5f, 0.5f, 0, 0,  0,    0}));
  glb.channel(0, 4, "rotation", "STEP", {5.0f / 24, 11.0f / 24, 20.0f / 24},
              glb.floats("VEC4", {0, 0, 0, 1, 0, 0, kHalf, kHalf, 0, 1, 0, 0}));
  glb.channel(0, 3, "scale", "LINEAR", {0, 1}, glb.floats("VEC3", {0.6f, 0.6f, 0.6f, 0.6f, 0.6f, 0.6f}));
  glb.channel(0, 4, "translation", "STEP", {0}, glb.floats("VEC3", {0.1f, 0.2f, 0.9f}));
  return glb;
}

TEST_F(GltfFilms, KeysPutTheVerticesOfASkinWhereTheFormulasDo) {
  const std::string bytes = walking().file();
  const std::string report = import(bytes);
  EXPECT_TRUE(holds(report, "film of 25 frames at 24 a second, actor 'file'")) << report;
  EXPECT_TRUE(holds(report, "the animation 'walk' of 1 s")) << report;
  EXPECT_TRUE(holds(report, "keys at 17 frames")) << report;
  EXPECT_TRUE(holds(report, "nothing: all of the file was read")) << report;
  expect_as_in_the_file(bytes);
  expect_joint(bytes, "hip", 2, 1e-5);
  expect_joint(bytes, "chest", 3, 1e-5);
  expect_joint(bytes, "head", 4, 5e-5);
}

TEST_F(GltfFilms, AtOtherRatesTheFormulasHoldToo) {
  const std::string bytes = walking().file();
  for (const double rate : {30.0, 7.5}) {
    import(bytes, [&](ImportOptions& options) { options.rate = rate;
  });
  EXPECT_EQ(film_.frames, std::floor(rate) + 1);
  expect_as_in_the_file(bytes);
}
}

TEST_F(GltfFilms, ScaledFilmsHaveTheSameMotion) {
  const std::string bytes = walking().file();
  import(bytes, [](ImportOptions& options) { options.size.scale = 10;
});
const test::PlainGltf file(bytes);
Places expected = file.vertices(0.5);
for (glm::dvec3& place : expected) place = 10.0 * upright(place);
const film::CompiledFilm compiled = film::compile(film_);
EXPECT_LT(farthest_from(expected, vertices_of(film_, compiled.view(), 12)), 5e-4);
}

TEST_F(GltfFilms, StraightWaysNeedFewKeys) {
  Glb glb = figure();
  glb.channel(0, 2, "translation", "LINEAR", {0, 0.5f, 2}, glb.floats("VEC3", {0, 0, 1, 1, 0, 1, 1, 2, 1}));
  glb.channel(0, 3, "rotation", "LINEAR", {0, 2}, glb.floats("VEC4", {0, 0.6f, 0, 0.8f, 0.6f, 0, 0, 0.8f}));
  const std::string bytes = glb.file(), report = import(bytes);
  EXPECT_TRUE(holds(report, "keys at 3 frames")) << report;
  EXPECT_EQ(actor().at("keys").at(1).at("frame"), 12);
  expect_as_in_the_file(bytes);
}

TEST_F(GltfFilms, BonesThatSlideAndChangeInScaleAreMovedByMatrices) {
  Glb glb = walking();
  glb.channel(0, 4, "scale", "CUBICSPLINE", {0, 1},
              glb.floats("VEC3", {0, 0, 0, 1, 1, 1, 1, 2, 3, 0, 0, 0, 2, 1, 0.5f, 0, 0, 0}));
  glb.json["animations"][0]["channels"].erase(5);
  glb.channel(0, 4, "translation", "LINEAR", {0, 1}, glb.floats("VEC3", {0.1f, 0.2f, 0.9f, 1, 0.2f, 0.9f}));
  const std::string bytes = glb.file(), report = import(bytes);
  EXPECT_TRUE(holds(report, "matrices at 25 frames: 1 joint slides, up to 1.21 units, and 1 joint changes in scale"))
      << report;
  EXPECT_FALSE(actor().contains("keys"));
  expect_as_in_the_file(bytes);
}

// Nodes of which none has bones: a matrix above, normalized shorts, mirrored and uneven scales, a mesh that two share.
TEST_F(GltfFilms, RigidNodesThatSlideAndScaleAreMovedByMatrices) {
  Glb glb;
  const int mesh = glb.triangle({0, 0, 0, 1, 0, 0, 0, 1, 0.5f});
  glb.json["nodes"] = {
      {{"name", "frame"}, {"matrix", {0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 1, 2, 3, 1}}, {"children", {1, 2}}},
      {{"name", "piston"}, {"mesh", mesh}, {"scale", {1, -2, 0.5}}},
      {{"name", "wheel"}, {"mesh", mesh}, {"translation", {3, 0, 0}}}};
  glb.json["animations"] = {{{"name", "run"}}};
  glb.channel(0, 1, "translation", "CUBICSPLINE", {0, 1},
              glb.floats("VEC3", {0, 0, 0, 0, 0, 0, 1, 2, 3, 0, 0, 0, 1, 1, 0, 0, 0, 0}));
  const int turns = glb.shorts("VEC4", {0, 0, 0, 32767, 0, 0, 23170, 23170});
  glb.json["accessors"][static_cast<std::size_t>(turns)]["normalized"] = true;
  glb.channel(0, 2, "rotation", "LINEAR", {0, 1}, turns);
  glb.channel(0, 2, "scale", "STEP", {0, 0.5f}, glb.floats("VEC3", {1, 1, 1, 2, 1, 1}));
  const std::string bytes = glb.file(), report = import(bytes);
  EXPECT_TRUE(holds(report, "joints of 3 nodes")) << report;
  EXPECT_TRUE(holds(report, "matrices at 25 frames: 1 joint slides")) << report;
  expect_as_in_the_file(bytes);
}

TEST_F(GltfFilms, KeysCanBeChosenAndTheReportHasWhatTheyDoNotShow) {
  Glb glb = figure();
  glb.channel(0, 4, "translation", "LINEAR", {0, 1}, glb.floats("VEC3", {0, 0.2f, 0.8f, 1, 0.2f, 0.8f}));
  glb.channel(0, 3, "translation", "LINEAR", {0, 1}, glb.floats("VEC3", {0.1f, 0, 0.5f, 1, 0, 0.5f}));
  const std::string bytes = glb.file();
  const std::string report = import(bytes, [](ImportOptions& options) { options.motion = ImportMotion::keys; });
  EXPECT_TRUE(holds(report, "how 2 joints slide, up to 1.8 units")) << report;
  EXPECT_FALSE(actor().contains("matrices"));
  EXPECT_TRUE(holds(import(bytes), "matrices at 25 frames: 2 joints slide")) << report;
  expect_as_in_the_file(bytes);
}

TEST_F(GltfFilms, AnAnimationIsChosenByItsName) {
  Glb glb = walking();
  glb.json["animations"].push_back({{"name", "nod"}});
  glb.channel(1, 4, "rotation", "LINEAR", {0, 0.5f}, glb.floats("VEC4", {0, 0, 0, 1, 0, 0, kHalf, kHalf}));
  glb.channel(2, 4, "rotation", "STEP", {0}, glb.floats("VEC4", {0, 0, 0, 1}));
  const std::string bytes = glb.file();
  EXPECT_TRUE(holds(import(bytes), "2 further animations: nod, animation 3 (--animation chooses one)"));
  const std::string report = import(bytes, [](ImportOptions& options) { options.animation = "nod"; });
  EXPECT_TRUE(holds(report, "film of 13 frames")) << report;
  EXPECT_TRUE(holds(report, "2 further animations: walk, animation 3")) << report;
  expect_as_in_the_file(bytes, 1);
  const std::string failure = failure_of([&] { import(bytes, [](auto& options) { options.animation = "run";
  });
});
EXPECT_TRUE(holds(failure, "has no animation 'run' (it has: walk, nod, animation 3)")) << failure;
}

TEST_F(GltfFilms, RatesFollowTheTimesOfTheFile) {
  Glb glb = figure();
  glb.channel(0, 2, "translation", "LINEAR", {0, 1.0f / 60, 0.2f}, glb.floats("VEC3", {0, 0, 1, 1, 0, 1, 1, 2, 1}));
  EXPECT_TRUE(holds(import(glb.file()), "film of 7 frames at 30 a second"));
  Glb odd = figure();
  odd.channel(0, 2, "translation", "LINEAR", {0, 0.123f, 0.777f}, odd.floats("VEC3", {0, 0, 1, 1, 0, 1, 1, 2, 1}));
  EXPECT_TRUE(holds(import(odd.file()), "film of 19 frames at 24 a second"));
}

TEST_F(GltfFilms, WeightsOfTargetsAreReported) {
  Glb glb = figure();
  glb.channel(0, 1, "weights", "LINEAR", {0, 1}, glb.floats("SCALAR", {0, 1}));
  const std::string report = import(glb.file());
  EXPECT_TRUE(holds(report, "film of 1 frame")) << report;
  EXPECT_TRUE(holds(report, "1 animated weight of morph targets")) << report;
}

TEST_F(GltfFilms, ACameraOfTheFileIsTheFilms) {
  Glb glb;
  glb.json["nodes"] = {{{"name", "box"}, {"mesh", glb.triangle({0, 0, 0, 1, 0, 0, 0, 1, 0})}},
                       {{"name", "still"}, {"camera", 1}},
                       {{"name", "flies"}, {"camera", 0}, {"translation", {0, 1, 10}}}};
  glb.json["scenes"][0]["nodes"] = {0, 1, 2};
  glb.json["cameras"] = {
      {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"aspectRatio", 2}, {"znear", 0.5}, {"zfar", 80}}}},
      {{"type", "orthographic"}, {"orthographic", {{"xmag", 4}, {"ymag", 3}, {"znear", 1}, {"zfar", 9}}}}};
  Glb flying = glb;
  flying.json["animations"] = {{{"name", "fly"}}};
  flying.channel(0, 2, "translation", "LINEAR", {0, 1}, flying.floats("VEC3", {0, 1, 10, 24, 1, 10}));
  flying.channel(0, 2, "rotation", "STEP", {0}, flying.floats("VEC4", {0, 0, 0, 1}));
  const std::string report = import(flying.file());
  EXPECT_TRUE(holds(report, "1 further camera")) << report;
  const Json& camera = json_.at("camera");
  EXPECT_NEAR(camera.at("fov").get<double>(), 28.6478898, 1e-6);
  EXPECT_EQ(camera.at("near"), 0.5);
  EXPECT_EQ(camera.at("far"), 80);
  EXPECT_EQ(json_.at("size"), Json::array({1080, 540}));
  EXPECT_EQ(camera.at("keys").size(), 2u);
  EXPECT_EQ(camera.at("keys").at(0).at("eye"), Json::array({0, -10, 1}));
  EXPECT_EQ(camera.at("keys").at(1).at("eye"), Json::array({24, -10, 1}));
  EXPECT_EQ(camera.at("keys").at(1).at("at").at(2), 1);
  import(glb.file(), [](ImportOptions& options) { options.size.scale = 2;
});
EXPECT_EQ(json_.at("camera").at("projection"), "orthographic");
EXPECT_EQ(json_.at("camera").at("height"), 12);
EXPECT_EQ(json_.at("size"), Json::array({720, 540}));
}

TEST_F(GltfFilms, LightsOfTheFileAreTheFilms) {
  Glb glb;
  const auto light = [](int number) { return nlohmann::json{{"KHR_lights_punctual", {{"light", number}}}}; };
  glb.json["nodes"] = {{{"name", "box"}, {"mesh", glb.triangle({-1, 0, 0, 1, 0, 0, 0, 0, 1})}},
                       {{"rotation", {-kHalf, 0, 0, kHalf}}, {"extensions", light(0)}},
                       {{"translation", {0, 5, 0}}, {"extensions", light(1)}},
                       {{"translation", {0, 4, 0}}, {"rotation", {-kHalf, 0, 0, kHalf}}, {"extensions", light(2)}}};
  glb.json["scenes"][0]["nodes"] = {0, 1, 2, 3};
  glb.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "directional"}, {"intensity", 3.14159265358979}},
      {{"type", "point"}, {"intensity", 20}, {"color", {1, 0.5, 0}}},
      {{"type", "spot"}, {"intensity", 10}, {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.5}}}}};
  const std::string report = import(glb.file());
  EXPECT_TRUE(holds(report, "made       3 lights\n") || holds(report, " 3 lights\n")) << report;
  const Json& lights = json_.at("lights");
  EXPECT_NEAR(lights.at(0).at("direction").at(2).get<double>(), 1, 1e-7);  // shines down
  EXPECT_NEAR(lights.at(0).at("intensity").get<double>(), 1, 1e-6);
  const auto brightness = [&](std::size_t number, double far) {
    const double reach = lights.at(number).at("reach");
    return lights.at(number).at("intensity").get<double>() / (1 + far * far / reach / reach);
  };
  EXPECT_NEAR(brightness(1, 5), 20 / (25 * 3.14159265), 2e-3 * brightness(1, 5));
  EXPECT_EQ(lights.at(1).at("color"), Json::array({1, 0.735, 0}));
  EXPECT_EQ(lights.at(2).at("place"), Json::array({0, 0, 4}));
  EXPECT_LT(lights.at(2).at("at").at(2).get<double>(), 4);
  EXPECT_NEAR(lights.at(2).at("cone").at(1).get<double>(), 57.2957795, 1e-5);
  glb.json["extensions"]["KHR_lights_punctual"]["lights"][0]["intensity"] = 314159.265358979;
  EXPECT_TRUE(holds(import(glb.file()), "times as bright as in the file"));
  EXPECT_NEAR(json_.at("lights").at(0).at("intensity").get<double>(), 1, 1e-3);
}

TEST_F(GltfFilms, DamagedAnimationsAreRefused) {
  const auto refused = [&](Glb glb) { return failure_of([&] { import(glb.file()); }); };
  Glb backward = figure();
  backward.channel(0, 4, "rotation", "LINEAR", {1, 0}, backward.floats("VEC4", {0, 0, 0, 1, 0, 0, 1, 0}));
  EXPECT_TRUE(holds(refused(backward), "whose times do not ascend")) << refused(backward);
  Glb few = figure();
  few.channel(0, 4, "rotation", "CUBICSPLINE", {0, 1}, few.floats("VEC4", {0, 0, 0, 1, 0, 0, 1, 0}));
  EXPECT_TRUE(holds(refused(few), "not one value for each of its times")) << refused(few);
  Glb sparse = figure();
  sparse.channel(0, 4, "rotation", "LINEAR", {0}, sparse.floats("VEC4", {0, 0, 0, 1}));
  sparse.json["accessors"].back()["sparse"] = {{"count", 0}};
  EXPECT_TRUE(holds(refused(sparse), "has numbers beyond the end of their buffer")) << refused(sparse);
  Glb nan = figure();
  nan.channel(0, 4, "rotation", "LINEAR", {0}, nan.floats("VEC4", {0, 0, NAN, 1}));
  EXPECT_TRUE(holds(refused(nan), "a number that is none")) << refused(nan);
}

TEST_F(GltfFilms, OptionsOfFilmsNeedAFilm) {
  ImportOptions options = options_for(write("file.glb", figure().file()));
  options.animation = "walk";
  EXPECT_TRUE(holds(failure_of([&] { import_model(options); }), "--animation or --motion (add --as film"));
  options.animation = "";
  options.rate = 24;
  EXPECT_TRUE(holds(failure_of([&] { import_model(options); }), "--rate (add --as film"));
}

// Places of a mesh and values of an animation, of which all but one are in the file as they are.
TEST_F(GltfFilms, SparseNumbersAreReplaced) {
  Glb glb;
  const int mesh = glb.triangle({0, 0, 0, 1, 0, 0, 0, 0, 1});
  const int places = static_cast<int>(glb.json["accessors"].size()) - 1;
  glb.json["nodes"] = {{{"mesh", mesh}}};
  glb.channel(0, 0, "translation", "LINEAR", {0, 1}, glb.floats("VEC3", {0, 0, 0, 9, 9, 9}));
  const int values = static_cast<int>(glb.json["accessors"].size()) - 2;
  const auto replace = [&](int accessor, char place, const std::vector<float>& with) {
    const int view = glb.json["accessors"][std::size_t(glb.floats("VEC3", with))]["bufferView"];
    glb.json["accessors"][std::size_t(accessor)]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", glb.view(std::string(1, place))}, {"componentType", 5121}}},
        {"values", {{"bufferView", view}}}};
  };
  replace(places, 2, {0, 0, 5});
  replace(values, 1, {3, 0, 0});
  import(glb.file());
  const film::CompiledFilm compiled = film::compile(film_);
  const Places last = vertices_of(film_, compiled.view(), film_.frames - 1);
  EXPECT_LT(farthest_from({{3, 0, 0}, {4, 0, 0}, {3, -5, 0}}, last), 1e-5);
  glb.json["accessors"][std::size_t(values)]["sparse"]["indices"]["bufferView"] = glb.view("\7");
  EXPECT_TRUE(holds(failure_of([&] { import(glb.file()); }), "reaches beyond its numbers"));
}

TEST_F(GltfFilms, MorphTargetsShapeTheMeshAtItsWeights) {
  Glb glb;
  const int mesh = glb.triangle({0, 0, 0, 1, 0, 0, 0, 0, 1});
  auto& json = glb.json["meshes"][0];
  json["primitives"][0]["targets"] = {{{"POSITION", glb.floats("VEC3", {0, 0, 0, 2, 0, 0, 0, 0, 0})}},
                                      {{"POSITION", glb.floats("VEC3", {0, 0, 0, 0, 0, 0, 0, 4, 0})}}};
  json["weights"] = {0.5, 0};
  glb.json["nodes"] = {{{"mesh", mesh}}};
  const std::string report = import(glb.file());
  EXPECT_TRUE(holds(report, "the shape at the file's weights of 1 morph target")) << report;
  const film::CompiledFilm compiled = film::compile(film_);
  EXPECT_LT(farthest_from({{0, 0, 0}, {2, 0, 0}, {0, -1, 0}}, vertices_of(film_, compiled.view(), 0)), 1e-5);
}

TEST_F(GltfFilms, TimesAreSingleNumbers) {
  Glb glb;
  const int mesh = glb.triangle({0, 0, 0, 1, 0, 0, 0, 0, 1});
  glb.json["nodes"] = {{{"mesh", mesh}}};
  glb.json["scenes"] = {{{"nodes", {0}}}};
  const int times = glb.floats("VEC2", {0, 1}), values = glb.floats("VEC3", {0, 0, 0, 1, 0, 0});
  glb.json["animations"] = {{{"samplers", {{{"input", times}, {"output", values}}}},
                             {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
  EXPECT_TRUE(holds(failure_of([&] { import(glb.file()); }), "whose times are no single numbers"));
}

TEST_F(GltfFilms, WhatIsNoListIsRefused) {
  for (const char* list : {"nodes", "meshes", "accessors", "buffers", "bufferViews", "animations", "skins", "cameras"})
    for (const char* value : {"360", "\"x\"", "{\"a\": {}}"}) {
      ImportOptions options = options_for(write("odd.gltf", std::string("{\"") + list + "\": " + value + "}"));
      options.as = ImportAs::film;
      const std::string refusal = failure_of([&] { import_model(options); });
      EXPECT_TRUE(holds(refusal, std::string("odd.gltf: has ") + list + " that are no list")) << refusal;
    }
}

}  // namespace
}  // namespace mars::importer
