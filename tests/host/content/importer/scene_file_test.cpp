// glTF's scenes: where skins put vertices, which joints nodes become, what stands for materials and textures. Small
// files have their right answers from glTF's rules by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <limits>
#include <vector>

#include "host/content/modeler/bent_skin.h"
#include "host/content/modeler/frames.h"
#include "host/content/modeler/read_model.h"
#include "host/images/picture_file.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/host/content/importer/glb.h"
#include "tests/host/content/importer/import_folder.h"

namespace mars::importer {
namespace {

namespace fs = std::filesystem;
using Places = std::vector<glm::dvec3>;
using nlohmann::json;

const json kQuarterAboutX = {0.70710678, 0, 0, 0.70710678}, kQuarterAboutZ = {0, 0, 0.70710678, 0.70710678};

class SceneFileTest : public ImportFolder {
 protected:
  modeler::Model import(const ImportOptions& options) const {
    printed_ = import_model(options);
    return modeler::load_model(options.to);
  }
  modeler::Model import(test::Glb& glb) const { return import(options_for(write("file.glb", glb.file()))); }
  std::string failure(test::Glb& glb) const {
    return document::failure_of([&] { import_model(options_for(write("file.glb", glb.file()))); });
  }
  void expect_printed(const char* part) const { EXPECT_TRUE(document::holds(printed_, part)) << printed_; }

  mutable std::string printed_;
};

const modeler::Joint& joint_named(const modeler::Model& model, const std::string& name) {
  const auto found = std::ranges::find(model.joints, name, &modeler::Joint::name);
  if (found == model.joints.end()) throw std::runtime_error("no joint " + name);
  return *found;
}

glm::dmat3 axes_of(const modeler::Joint& joint) {
  return {joint.x_axis, joint.y_axis, glm::cross(joint.x_axis, joint.y_axis)};
}

// The joint's vertices where they stand at rest, when no joint is turned.
Places places_of(const modeler::Model& model, const modeler::Joint& joint) {
  glm::dvec3 origin = joint.place;
  for (std::size_t above = joint.parent; above != modeler::kNone; above = model.joints[above].parent)
    origin += model.joints[above].place;
  const modeler::Box& box = joint.segment->sbb;
  Places places;
  if (!joint.segment->bones.empty()) {
    const std::vector<modeler::Axes> frames = modeler::rest_frames(model);
    std::vector<wire::Matrix> bones;
    for (const modeler::Bone& bone : joint.segment->bones)
      bones.push_back(modeler::bone_matrix(frames[bone.joint], bone, joint));
    const modeler::Mesh& mesh = *model.shapes[joint.segment->shape].mesh;
    const modeler::BentSkin skin(bones, joint.segment->blend);
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
      places.push_back(skin.place_of(mesh.vertices[v], mesh.bones[v]));
    return places;
  }
  for (const auto& vertex : model.shapes[joint.segment->shape].mesh->vertices)
    places.push_back(origin +
                     axes_of(joint) * (box.min + glm::dvec3(vertex[0], vertex[1], vertex[2]) * (box.max - box.min)));
  return places;
}

void expect_places(const Places& places, const Places& expected, double within = 1e-6) {
  ASSERT_EQ(places.size(), expected.size());
  for (std::size_t i = 0; i < places.size(); ++i)
    EXPECT_LT(glm::distance(places[i], expected[i]), within)
        << "vertex " << i << " at " << places[i].x << " " << places[i].y << " " << places[i].z;
}

// As exporters write a Mixamo figure: in centimetres with z up, under a node that makes it metres with y up; a hip at
// (0, 0, 100) cm, and at rest 50 cm above it a chest.
test::Glb figure(const std::vector<float>& weights = {1, 0, 0, 0, 0, 1, 0, 0, 0.5f, 0.5f, 0, 0}) {
  test::Glb glb;
  const int joints = glb.bytes("VEC4", {0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}), weight = glb.floats("VEC4", weights);
  const int mesh = glb.triangle({10, 0, 0, 20, 0, 180, 0, 0, 150}, {{"JOINTS_0", joints}, {"WEIGHTS_0", weight}});
  // Column by column: places in centimetres seen from the hip, and from the chest.
  const int inverse = glb.floats("MAT4", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -100, 1,  //
                                          1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -150, 1});
  glb.json["nodes"] = {
      {{"name", "Armature"},
       {"scale", {0.01, 0.01, 0.01}},
       {"rotation", {-0.70710678, 0, 0, 0.70710678}},
       {"children", {1, 2}}},
      {{"name", "Hips"}, {"mesh", mesh}, {"skin", 0}, {"translation", {70, 80, 90}}, {"scale", {3, 3, 3}}},
      {{"name", "Hips"}, {"translation", {0, 0, 100}}, {"children", {3}}},
      {{"name", "Chest"}, {"translation", {0, 0, 50}}}};
  glb.json["skins"] = {{{"joints", {2, 3}}, {"inverseBindMatrices", inverse}}};
  return glb;
}

TEST_F(SceneFileTest, ASkinnedFigureStandsUprightInMetres) {
  test::Glb glb = figure();
  const modeler::Model model = import(glb);
  ASSERT_EQ(model.joints.size(), 4u) << "the file, and the nodes that are bones or carry some";
  EXPECT_EQ(model.joints[0].name, "file");
  expect_places(places_of(model, model.joints[0]), {{0.1, 0, 0}, {0.2, 0, 1.8}, {0, 0, 1.5}});
  expect_printed("1.8 m tall");
  expect_printed("  made       joints of 3 nodes\n             a skin, which 2 joints move, of 1 mesh\n");
}

// The chest turns by a quarter about the figure's z: what it holds goes from x to y, what both hold goes half way.
TEST_F(SceneFileTest, JointsThatAreTurnedInTheFileTakeTheirVerticesAlong) {
  test::Glb glb = figure();
  glb.json["nodes"][3]["rotation"] = kQuarterAboutZ;
  glb.json["nodes"][3]["translation"] = {30, 0, 50};
  const modeler::Model model = import(glb);
  expect_places(places_of(model, model.joints[0]), {{0.1, 0, 0}, {0.3, 0.2, 1.8}, {0.15, 0, 1.5}});
}

TEST_F(SceneFileTest, WeightsThatDoNotAddUpToOneAreMadeTo) {
  test::Glb glb = figure({0.5f, 0, 0, 0, 0, 3, 0, 0, 0, 0, 0, 0});
  const modeler::Model model = import(glb);
  expect_places(places_of(model, model.joints[0]), {{0.1, 0, 0}, {0.2, 0, 1.8}, {0, 0, 1.5}});
}

// A sword in a hand: it follows the bones' nodes, which become joints; the figure stands on the first.
TEST_F(SceneFileTest, WhatHangsOnABoneIsAJoint) {
  test::Glb glb = figure();
  const int sword = glb.triangle({0, 0, 0, 0, 100, 0, 10, 0, 0});
  glb.json["nodes"].push_back({{"name", "sword"}, {"mesh", sword}, {"translation", {40, 0, 0}}});
  glb.json["nodes"][3]["children"] = {4};
  const modeler::Model model = import(glb);
  ASSERT_EQ(model.joints.size(), 5u);
  EXPECT_TRUE(model.joints[0].segment);
  EXPECT_EQ(model.joints[joint_named(model, "sword").parent].name, "Chest");
  EXPECT_EQ(joint_named(model, "Chest").freedoms(), 3);
  expect_places(places_of(model, joint_named(model, "sword")), {{0.4, 0, 1.5}, {0.4, 1, 1.5}, {0.5, 0, 1.5}});
}

TEST_F(SceneFileTest, WeightsMayBeBytes) {
  test::Glb packed = figure(), plain = figure({1, 0, 0, 0, 0, 1, 0, 0, 0.2f, 0.8f, 0, 0});
  const int weights = packed.bytes("VEC4", {255, 0, 0, 0, 0, 255, 0, 0, 51, 204, 0, 0});
  packed.json["accessors"][static_cast<std::size_t>(weights)]["normalized"] = true;
  packed.json["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"] = weights;
  EXPECT_EQ(import(packed).shapes.at(0).mesh->bones, import(plain).shapes.at(0).mesh->bones);
}

TEST_F(SceneFileTest, AttributesThatDoNotFitTheMeshAreRefused) {
  const auto with = [&](const char* name, const char* key, const nlohmann::json& value) {
    test::Glb glb = figure();
    const auto index = glb.json["meshes"][0]["primitives"][0]["attributes"].at(name).get<std::size_t>();
    glb.json["accessors"][index][key] = value;
    return failure(glb);
  };
  constexpr const char* kProblem = "has a mesh whose places, normals, weights or the like do not fit each other (";
  EXPECT_TRUE(document::holds(with("JOINTS_0", "count", 2), kProblem)) << with("JOINTS_0", "count", 2);
  EXPECT_TRUE(document::holds(with("WEIGHTS_0", "type", "VEC2"), kProblem));
  test::Glb second = figure();
  auto& attributes = second.json["meshes"][0]["primitives"][0]["attributes"];
  attributes["WEIGHTS_1"] = attributes["WEIGHTS_0"];
  attributes["JOINTS_1"] = attributes["JOINTS_0"];
  attributes.erase("WEIGHTS_0");
  EXPECT_TRUE(document::holds(failure(second), kProblem));
}

// What a model cannot be is said of the file, not of the model that is not written.
TEST_F(SceneFileTest, FilesThatMakeNoModelAreNamed) {
  test::Glb glb = figure({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
  std::vector<float> matrices;
  for (std::size_t joint = 0; joint < glb.json["skins"][0]["joints"].size(); ++joint)
    for (int i = 0; i < 16; ++i) matrices.push_back(i % 5 == 0 ? 1.0f : 0.0f);
  matrices.back() = std::numeric_limits<float>::infinity();
  glb.json["skins"][0]["inverseBindMatrices"] = glb.floats("MAT4", matrices);
  EXPECT_TRUE(document::holds(failure(glb), "file.glb: makes a model that MARS refuses: ")) << failure(glb);
}

TEST_F(SceneFileTest, SkinsThatCannotBeReadAreRefused) {
  test::Glb none = figure();
  none.json["skins"][0].erase("inverseBindMatrices");
  EXPECT_TRUE(document::holds(failure(none), "file.glb: has a skin without inverse bind matrices (")) << failure(none);
  test::Glb few = figure();
  few.json["accessors"][few.json["skins"][0]["inverseBindMatrices"].get<std::size_t>()]["count"] = 1;
  EXPECT_TRUE(document::holds(failure(few), "has a skin with fewer inverse bind matrices than joints ("))
      << failure(few);
  test::Glb twice = figure();
  twice.json["skins"].push_back(twice.json["skins"][0]);
  const std::size_t joints = twice.json["skins"][0]["joints"].size();
  twice.json["skins"][1]["inverseBindMatrices"] = twice.floats("MAT4", std::vector<float>(16 * joints));
  twice.json["nodes"].push_back({{"mesh", 0}, {"skin", 1}});
  EXPECT_TRUE(document::holds(failure(twice), "has a mesh under two skins ("));
  test::Glb same = figure();
  same.json["nodes"][3]["name"] = "Hips";
  EXPECT_TRUE(document::holds(failure(same), "is no sound mesh file: two of its bones have one name ("));
}

TEST_F(SceneFileTest, OnlyTheMeshWithoutNormalsHasFlatFaces) {
  test::Glb glb;
  const int normals = glb.floats("VEC3", {0.6f, 0, 0.8f, 0, 0.6f, 0.8f, 0, 0, 1});
  const int smooth = glb.triangle({0, 0, 0, 1, 0, 0, 0, 1, 0}, {{"NORMAL", normals}});
  const int flat = glb.triangle({0, 0, 0, 1, 0, 0, 0, 1, 0});
  glb.json["nodes"] = {{{"name", "smooth"}, {"mesh", smooth}, {"children", {1, 2}}},
                       {{"name", "flat"}, {"mesh", flat}},
                       {{"name", "mirrored"}, {"mesh", flat}, {"scale", {-1, 1, 1}}}};
  const modeler::Model model = import(glb);
  const auto normals_of = [&](const modeler::Joint& joint) { return model.shapes[joint.segment->shape].mesh->normals; };
  const auto curved = normals_of(model.joints[0]);
  ASSERT_EQ(curved.size(), 3u);
  EXPECT_GT(curved[0][0], 0.1f);
  EXPECT_GT(curved[1][2], 0.1f) << "the file's y is our z";
  for (const char* name : {"flat", "mirrored"}) {
    ASSERT_EQ(normals_of(joint_named(model, name)).size(), 3u);
    for (const auto& normal : normals_of(joint_named(model, name)))
      EXPECT_EQ(normal, (modeler::Mesh::Place{0, -1, 0})) << name;
  }
}

// A truck that is turned and twice as large, with four wheels of one mesh, the third mirrored, the fourth larger.
test::Glb truck() {
  test::Glb glb;
  const int body = glb.triangle({0, 0, 0, 1, 0, 0, 0, 1, 0}), wheel = glb.triangle({0, 0, 0, 1, 0, 0, 0, 0, 1});
  glb.json["nodes"] = {{{"name", "truck"},
                        {"mesh", body},
                        {"translation", {0, 0, 5}},
                        {"scale", {2, 2, 2}},
                        {"rotation", kQuarterAboutZ},
                        {"children", {1, 2, 3, 4, 5}}},
                       {{"name", "a/wheel"}, {"mesh", wheel}, {"translation", {1, 0, 0}}},
                       {{"name", "a/wheel"}, {"mesh", wheel}, {"translation", {0, 1, 0}}, {"rotation", kQuarterAboutX}},
                       {{"name", "left"}, {"mesh", wheel}, {"scale", {-1, 1, 1}}},
                       {{"mesh", wheel}, {"scale", {3, 3, 3}}},
                       {{"name", "lamp"}, {"children", {6}}},
                       {{"name", "nothing"}}};
  return glb;
}

TEST_F(SceneFileTest, NodesAreJointsThatStandAsTheNodes) {
  test::Glb glb = truck();
  const modeler::Model model = import(glb);
  ASSERT_EQ(model.joints.size(), 5u) << "nodes without meshes are left out";
  EXPECT_EQ(model.joints[0].name, "file");
  for (const char* name : {"a-wheel", "a-wheel-2", "left", "node"}) {
    EXPECT_EQ(joint_named(model, name).parent, 0u);
    EXPECT_EQ(joint_named(model, name).freedoms(), 3);
  }
  EXPECT_EQ(model.joints[0].place, glm::dvec3(0, -5, 0)) << "5 along the file's z, which y up turns into -y";
  // Turned by a quarter about the file's z: its x points along the file's y, ours z; its y along -x.
  EXPECT_EQ(model.joints[0].x_axis, glm::dvec3(0, 0, 1));
  expect_places(places_of(model, model.joints[0]), {{0, -5, 0}, {0, -5, 2}, {-2, -5, 0}});
  expect_places(places_of(model, joint_named(model, "a-wheel")), {{0, -5, 2}, {0, -5, 4}, {0, -7, 2}});
  expect_places(places_of(model, joint_named(model, "a-wheel-2")), {{-2, -5, 0}, {-2, -5, 2}, {0, -5, 0}});
  expect_places(places_of(model, joint_named(model, "left")), {{0, -5, 0}, {0, -5, -2}, {0, -7, 0}});
  expect_places(places_of(model, joint_named(model, "node")), {{0, -5, 0}, {0, -5, 6}, {0, -11, 0}});
  expect_printed("joints of 5 nodes");
}

TEST_F(SceneFileTest, AMeshThatStandsSeveralTimesIsStoredOnce) {
  test::Glb glb = truck();
  const modeler::Model model = import(glb);
  EXPECT_EQ(joint_named(model, "a-wheel").segment->shape, joint_named(model, "a-wheel-2").segment->shape);
  EXPECT_EQ(joint_named(model, "a-wheel").segment->shape, joint_named(model, "node").segment->shape);
  EXPECT_NE(joint_named(model, "a-wheel").segment->shape, joint_named(model, "left").segment->shape) << "mirrored";
}

// A turned child under an uneven scale is sheared: the mesh is, its joint's axes are not.
TEST_F(SceneFileTest, AShearIsRightAtRestAndListed) {
  test::Glb glb;
  const int mesh = glb.triangle({0, 0, 0, 1, 0, 0, 0, 1, 0});
  glb.json["nodes"] = {{{"name", "wide"}, {"scale", {4, 1, 1}}, {"children", {1}}},
                       {{"name", "turned"}, {"mesh", mesh}, {"rotation", {0, 0, 0.38268343, 0.92387953}}}};
  const modeler::Model model = import(glb);
  const double half = std::sqrt(0.5);
  const modeler::Joint& turned = joint_named(model, "turned");
  expect_places(places_of(model, turned), {{0, 0, 0}, {4 * half, 0, half}, {-4 * half, 0, half}});
  EXPECT_NEAR(glm::dot(turned.x_axis, turned.y_axis), 0, 1e-6);
  expect_printed("an uneven scale above 1 joint: turned, they keep their shape at rest");
}

TEST_F(SceneFileTest, FacesOfMirroredNodesRunOutward) {
  test::Glb glb = truck();
  const modeler::Model model = import(glb);
  const auto normal = [&](const char* name) {
    const modeler::Joint& joint = joint_named(model, name);
    const Places places = places_of(model, joint);
    const auto face = model.shapes[joint.segment->shape].mesh->face(0);
    return glm::normalize(glm::cross(places[face[1]] - places[face[0]], places[face[2]] - places[face[0]]));
  };
  // The wheel looks along its -y; mirrored in its x, it still does.
  EXPECT_LT(glm::distance(normal("a-wheel"), glm::dvec3(1, 0, 0)), 1e-6);
  EXPECT_LT(glm::distance(normal("left"), glm::dvec3(1, 0, 0)), 1e-6);
}

TEST_F(SceneFileTest, LongAndEmptyNamesAreMadeNames) {
  test::Glb glb;
  const int mesh = glb.triangle({0, 0, 0, 1, 0, 0, 0, 1, 0});
  std::string e_acute;
  for (int i = 0; i < 60; ++i) e_acute += "\xc3\xa9";
  glb.json["scenes"][0]["nodes"] = {0, 1, 2};
  glb.json["nodes"] = {{{"name", "x" + e_acute}, {"mesh", mesh}}, {{"mesh", mesh}}, {{"name", "file"}, {"mesh", mesh}}};
  glb.json["meshes"][0]["name"] = "of\nthe mesh";
  const modeler::Model model = import(glb);
  ASSERT_EQ(model.joints.size(), 4u);
  EXPECT_EQ(model.joints[1].name, "x" + e_acute.substr(0, 88)) << "cut between letters";
  EXPECT_EQ(model.joints[2].name, "of-the mesh");
  EXPECT_EQ(model.joints[3].name, "file-2") << "the first joint has the file's name";
}

test::Glb painted(const json& material) {
  test::Glb glb;
  const int mesh = glb.triangle({0, 0, 0, 1, 0, 0, 0, 1, 0});
  glb.json["nodes"] = {{{"mesh", mesh}}};
  glb.json["meshes"][0]["primitives"][0]["material"] = 0;
  glb.json["materials"] = {material};
  return glb;
}

TEST_F(SceneFileTest, RoughnessAndMetalAreTheMaterials) {
  test::Glb glb = painted({{"pbrMetallicRoughness",
                            {{"baseColorFactor", {1, 0, 0, 1}}, {"roughnessFactor", 0.25}, {"metallicFactor", 0.75}}}});
  const modeler::NamedMaterial red = import(glb).materials.at(0);
  EXPECT_EQ(red.material.reflection, wire::Reflection::metallic_roughness);
  EXPECT_EQ(red.material.roughness, 0.25f);
  EXPECT_EQ(red.material.metallic, 0.75f);
  EXPECT_EQ(red.material.color, (std::array<float, 3>{1, 0, 0}));
  expect_printed("metallic-roughness of 1 material\n");
  test::Glb glossy = painted(
      {{"extensions",
        {{"KHR_materials_pbrSpecularGlossiness", {{"diffuseFactor", {0, 1, 0, 1}}, {"glossinessFactor", 0.9}}}}}});
  glossy.json["extensionsUsed"] = {"KHR_materials_pbrSpecularGlossiness"};
  const modeler::NamedMaterial green = import(glossy).materials.at(0);
  EXPECT_EQ(green.material.color, (std::array<float, 3>{0, 1, 0}));
  EXPECT_NEAR(green.material.roughness, 0.1, 1e-6);
  EXPECT_EQ(green.material.metallic, 0);
  test::Glb bare = painted({});
  bare.json["meshes"][0]["primitives"][0].erase("material");
  EXPECT_TRUE(import(bare).materials.empty()) << "a mesh without a material has MARS's own";
}

// The mean of black and white is half of white's light; half of that is a quarter, which is shown as 0.537.
TEST_F(SceneFileTest, ATexturesMeanStandsForIt) {
  const auto png = [](const std::vector<std::uint32_t>& pixels) {
    const std::vector<std::byte> bytes = images::encode_picture(images::PictureFormat::png, 2, 1, pixels);
    return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  };
  test::Glb glb = painted({{"pbrMetallicRoughness",
                            {{"baseColorFactor", {0.5, 1, 1, 1}},
                             {"baseColorTexture", {{"index", 0}}},
                             {"metallicRoughnessTexture", {{"index", 1}}},
                             {"roughnessFactor", 0.5}}}});
  glb.json["textures"] = {{{"source", 0}}, {{"source", 1}}};
  glb.json["images"] = {{{"bufferView", glb.view(png({0x000000, 0x00ffff}))}, {"mimeType", "image/png"}},
                        {{"uri", "rough%20and%20metal.png"}}};
  write("rough and metal.png", png({0xff0000, 0x00ff00}));
  const modeler::NamedMaterial made = import(glb).materials.at(0);
  EXPECT_EQ(made.material.color, (std::array<float, 3>{0.537f, 0.735f, 0}));
  EXPECT_EQ(made.material.roughness, 0.25f) << "half of the texture's green";
  EXPECT_EQ(made.material.metallic, 0.5f) << "half of its blue";
  expect_printed("a mean colour of 1 texture\n");
  expect_printed("a mean roughness and metal of 1 texture\n");
  EXPECT_FALSE(document::holds(printed_, "1 texture (one colour"));
  ImportOptions options = options_for(folder_ / "file.glb");
  options.to = folder_ / "rough and metal.png";
  EXPECT_TRUE(document::holds(document::failure_of([&] { import_model(options); }), "is the file that is read"));
}

TEST_F(SceneFileTest, ATextureThatCannotBeReadIsListed) {
  test::Glb glb =
      painted({{"pbrMetallicRoughness", {{"baseColorFactor", {1, 0, 0, 1}}, {"baseColorTexture", {{"index", 0}}}}}});
  glb.json["textures"] = {{{"source", 0}}};
  glb.json["images"] = {{{"bufferView", glb.view("\x89PNG and no more")}, {"mimeType", "image/png"}}};
  EXPECT_EQ(import(glb).materials.at(0).material.color, (std::array<float, 3>{1, 0, 0}));
  expect_printed("texture picture 1 (not a whole PNG picture: ");
  glb.json["images"] = {{{"bufferView", glb.view("RIFF....WEBP")}, {"mimeType", "image/webp"}}};
  import(glb);
  expect_printed("texture picture 1 (neither PNG nor JPEG)");
}

TEST_F(SceneFileTest, AnObjsTextureIsAveragedToo) {
  write("paint.mtl", "newmtl paint\nKd 1 1 1\nmap_Kd paint.png\n");
  const std::vector<std::byte> bytes =
      images::encode_picture(images::PictureFormat::png, 2, 1, std::vector<std::uint32_t>{0x000000, 0xffffff});
  write("paint.png", {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  const modeler::Model model =
      import(options_for(write("a.obj", "mtllib paint.mtl\nusemtl paint\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")));
  EXPECT_EQ(model.materials.at(0).material.color, (std::array<float, 3>{0.735f, 0.735f, 0.735f}));
  EXPECT_EQ(model.materials[0].material.reflection, wire::Reflection::phong);
}

TEST_F(SceneFileTest, AModelIsAsHighAsAsked) {
  test::Glb glb = truck();
  write("truck.glb", glb.file());
  ImportOptions options = options_for(folder_ / "truck.glb");
  options.size.height = 4;  // as it stands it is 8 high: from -2 to 6
  const modeler::Model model = import(options);
  EXPECT_LT(glm::distance(model.joints[0].place, glm::dvec3(0, -2.5, 0)), 1e-6);
  expect_places(places_of(model, joint_named(model, "node")), {{0, -2.5, 0}, {0, -2.5, 3}, {0, -5.5, 0}});
  expect_printed("x 4 units, 8 m tall in the file, the file's y upward");
  options.from = write("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n");
  EXPECT_TRUE(document::holds(document::failure_of([&] { import_model(options); }),
                              "flat.obj: is flat: it has no height (leave out --height"));
}

TEST_F(SceneFileTest, WhatPointsUpAndForwardIsAsked) {
  ImportOptions options = options_for(write("a.obj", "v 1 2 3\nv 2 2 3\nv 1 3 3\nf 1 2 3\n"));
  const auto first = [&](const char* up, const char* front) {
    options.up = up;
    options.front = front;
    const modeler::Model model = import(options);
    return places_of(model, model.joints[0])[0];
  };
  EXPECT_EQ(first("y", ""), glm::dvec3(1, -3, 2));
  EXPECT_EQ(first("-y", ""), glm::dvec3(1, 3, -2));
  EXPECT_EQ(first("-z", ""), glm::dvec3(1, -2, -3));
  EXPECT_EQ(first("x", ""), glm::dvec3(-2, -3, 1));
  EXPECT_EQ(first("-x", ""), glm::dvec3(2, -3, -1));
  EXPECT_EQ(first("y", "z"), glm::dvec3(3, 1, 2)) << "glTF's front becomes x, its left y";
  EXPECT_EQ(first("z", "-y"), glm::dvec3(-2, 1, 3));
  EXPECT_EQ(document::failure_of([&] { first("z", "-z"); }),
            "--front -z: is the axis that points up, or down (choose another, or what points up with --up)");
}

// Places and sizes whose sum or product wraps, or that are beyond the end.
TEST_F(SceneFileTest, NumbersOutsideOfTheirBufferAreRefused) {
  const auto expect_refused = [&](const char* list, std::size_t index, const char* key, std::uint64_t value) {
    test::Glb glb = figure();
    glb.json[list][index][key] = value;
    EXPECT_TRUE(document::holds(failure(glb), "file.glb: has numbers beyond the end of their buffer ("))
        << list << " " << key << " " << value << ": " << failure(glb);
  };
  for (const std::uint64_t beyond : std::vector<std::uint64_t>{18446744073709551604u, 4294967296u, 1000000u}) {
    expect_refused("accessors", 2, "byteOffset", beyond);
    expect_refused("accessors", 2, "count", beyond);
    expect_refused("bufferViews", 2, "byteOffset", beyond);
    expect_refused("bufferViews", 2, "byteLength", beyond);
    expect_refused("bufferViews", 2, "byteStride", beyond);
  }
}

// Files of others, where they lie beside the project. What is expected was computed from their buffers by glTF's rules,
// without MARS and Assimp.
TEST_F(SceneFileTest, FilesOfOthers) {
  const fs::path data = fs::path(MARS_SOURCE_DIR) / "../shared/data";
  if (!fs::exists(data / "BoxAnimated.glb") || !fs::exists(data / "RiggedFigure.glb"))
    GTEST_SKIP() << "no files in " << data;
  const modeler::Model box = import(options_for(data / "BoxAnimated.glb"));
  ASSERT_EQ(box.joints.size(), 5u) << "four nodes, of which two stand in the scene, and one that carries them";
  const modeler::Joint &inner = joint_named(box, "inner_box"), &outer = joint_named(box, "outer_box");
  EXPECT_EQ(inner.freedoms(), 3);
  EXPECT_EQ(outer.segment->sbb.max, glm::dvec3(0.5, 0.5, 0.5));
  EXPECT_LT(glm::distance(inner.segment->sbb.min, glm::dvec3(-0.33504, -0.33504, -0.5)), 1e-7);
  EXPECT_LT(glm::distance(inner.segment->sbb.max, glm::dvec3(0.33504, 0.33504, 0.5)), 1e-7);
  EXPECT_EQ(box.shapes[0].mesh->normals.size(), box.shapes[0].mesh->vertices.size());
  ImportOptions as_in_the_file = options_for(data / "RiggedFigure.glb");
  as_in_the_file.front = "x";
  const modeler::Model figure = import(as_in_the_file);
  expect_printed("365 vertices of the file's 370, 256 faces, normals, 1 colour");
  expect_printed("1.45 m tall");
  expect_printed("a skin, which 19 joints move, of 1 mesh");
  ASSERT_EQ(figure.joints[0].segment->bones.size(), 19u);
  const modeler::Box sbb = *modeler::rest_bounds(figure);
  EXPECT_LT(glm::distance(sbb.min, glm::dvec3(-0.58946097, -0.19497761, -0.00000015)), 1e-6);
  EXPECT_LT(glm::distance(sbb.max, glm::dvec3(0.58946130, 0.13091786, 1.44991997)), 1e-6);
}

}  // namespace
}  // namespace mars::importer
