#include "host/content/modeler/read_model.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "tests/host/content/document/failure_of.h"

namespace mars::modeler {
namespace {

Model model_of(const std::string& json) {
  const document::Document document(json, "m.json");
  return read_model(document.root());
}

std::string model_failure(const std::string& json) {
  return document::failure_of([&] { model_of(json); });
}

std::string with_joints(const std::string& joints) { return "{\"joints\": [" + joints + "]}"; }

TEST(ReadModel, FillsInDefaults) {
  const Model model = model_of(with_joints(R"({"name": "a", "segment": {"shape": "box"}})"));
  ASSERT_EQ(model.joints.size(), 1u);
  const Joint& joint = model.joints[0];
  EXPECT_EQ(joint.parent, kNone);
  EXPECT_EQ(joint.freedoms(), 3);
  EXPECT_EQ(joint.limits[1].lower, -180);
  EXPECT_EQ(joint.segment->sbb.max, glm::dvec3(1, 1, 1));
  EXPECT_EQ(model.shapes[joint.segment->shape].patches.size(), 6u);
}

TEST(ReadModel, LimitsLeaveFreedomOnlyToTheAxesTheyName) {
  const Model model = model_of(with_joints(R"({"name": "knee", "limits": {"y": [0, 150], "z": [20, 20]}})"));
  EXPECT_EQ(model.joints[0].freedoms(), 1);
  EXPECT_EQ(model.joints[0].rest(), glm::dvec3(0, 0, 20));
}

TEST(ReadModel, PutsParentsBeforeChildren) {
  const Model model = model_of(
      with_joints(R"({"name": "c", "parent": "b"}, {"name": "d"}, {"name": "a"}, {"name": "b", "parent": "a"})"));
  std::vector<std::string> names;
  for (const Joint& joint : model.joints) names.push_back(joint.name);
  EXPECT_EQ(names, (std::vector<std::string>{"a", "b", "c", "d"}));
  EXPECT_EQ(model.joints[2].parent, 1u);
}

TEST(ReadModel, MakesAPrimitiveOncePerOption) {
  const Model model = model_of(with_joints(R"({"name": "a", "segment": {"shape": "cone"}},
      {"name": "b", "segment": {"shape": "cone", "top": 0.5}}, {"name": "c", "segment": {"shape": "cone"}})"));
  EXPECT_EQ(model.shapes.size(), 2u);
  EXPECT_EQ(model.joints[0].segment->shape, model.joints[2].segment->shape);
}

std::string patch_of(const std::string& point) {
  std::string patch = "[" + point;
  for (int i = 1; i < 16; ++i) patch += ", [0, 0.5, 1]";
  return patch + "]";
}

TEST(ReadModel, TakesPatchesOfItsOwn) {
  const std::string shapes = R"(, "shapes": {"leaf": [)";
  const std::string joints = R"({"joints": [{"name": "a", "segment": {"shape": "leaf"}}])";
  const Model model = model_of(joints + shapes + patch_of("[0.25, 0, 0]") + "]}}");
  EXPECT_EQ(model.shapes[0].patches[0].points[0][0], 0.25f);
  EXPECT_TRUE(document::holds(model_failure(joints + shapes + patch_of("[1.25, 0, 0]") + "]}}"),
                              "shapes.leaf[0][0][0]: is 1.25"));
  EXPECT_TRUE(document::holds(model_failure(joints + shapes + "[[0, 0, 0]]]}}"), "has 1 items"));
}

struct Broken {
  const char* joints;
  const char* reported;
};

class BrokenModel : public testing::TestWithParam<Broken> {};

TEST_P(BrokenModel, IsOneClearError) {
  const std::string failure = model_failure(with_joints(GetParam().joints));
  EXPECT_TRUE(document::holds(failure, "m.json:1: joints")) << failure;
  EXPECT_TRUE(document::holds(failure, GetParam().reported)) << failure;
}

INSTANTIATE_TEST_SUITE_P(
    Table, BrokenModel,
    testing::Values(
        Broken{"", "is empty"}, Broken{R"({"parent": "x"})", "has no 'name'"}, Broken{R"({"name": "a/b"})", "'/'"},
        Broken{R"({"name": "a"}, {"name": "a"})", "second joint named 'a'"},
        Broken{R"({"name": "hand", "parent": "arn"}, {"name": "arm"})", "did you mean 'arm'?"},
        Broken{R"({"name": "a", "parent": "a"})", "joint 'a' is its own ancestor"},
        Broken{R"({"name": "a", "parent": "c"}, {"name": "b", "parent": "a"}, {"name": "c", "parent": "b"})",
               "is its own ancestor"},
        Broken{R"({"name": "a", "place": [0, 0, 1e308]})", "joints[0].place[2]: is 1e+308"},
        Broken{R"({"name": "a", "x_axis": [0, 0, 0]})", "has no length"},
        Broken{R"({"name": "a", "y_axis": [5, 0, 0]})", "parallel"},
        Broken{R"({"name": "a", "limits": {"y": [10, -10]}})", "joints[0].limits.y: has its lower limit above"},
        Broken{R"({"name": "a", "segment": {}})", "has no 'shape'"},
        Broken{R"({"name": "a", "segment": {"shape": "bix"}})", "did you mean 'box'?"},
        Broken{R"({"name": "a", "segment": {"shape": "box", "tube": 0.1}})", "belongs to the shape torus"},
        Broken{R"({"name": "a", "segment": {"shape": "torus", "tube": 0.3}})", "0.2499"},
        Broken{R"({"name": "a", "segment": {"shape": "box", "sbb": [[0, 0, 0], [1, 0, 1]]}})", "no extent along y"},
        Broken{R"({"name": "a", "segment": {"shape": "box", "material": "gold"}})", "add it to the materials"}));

TEST(ReadModel, HundredThousandJointsInAChainAreFine) {
  std::string joints;
  for (int i = 99'999; i > 0; --i)
    joints += "{\"name\": \"j" + std::to_string(i) + "\", \"parent\": \"j" + std::to_string(i - 1) + "\"},\n";
  const Model model = model_of(with_joints(joints + R"({"name": "j0"})"));
  ASSERT_EQ(model.joints.size(), 100'000u);
  EXPECT_EQ(model.joints[99'999].parent, 99'998u);
  const std::string cycle = model_failure(with_joints(joints + R"({"name": "j0", "parent": "j99999"})"));
  EXPECT_TRUE(document::holds(cycle, "is its own ancestor")) << cycle;
}

}  // namespace
}  // namespace mars::modeler
