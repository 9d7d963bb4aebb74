#include "host/content/modeler/proportions.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "host/content/document/whole_file.h"
#include "host/content/modeler/frames.h"
#include "host/content/modeler/read_model.h"
#include "host/content/modeler/scale_model.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/temporary_folder.h"

namespace mars::modeler {
namespace {

namespace fs = std::filesystem;

constexpr const char* kArm = R"({"joints": [
    {"name": "arm", "place": [1, 1, 4], "limits": {}, "segment": {"shape": "box", "sbb": [[-0.5, -0.5, -2], [0.5, 0.5, 0]]}},
    {"name": "left-hand", "parent": "arm", "place": [0.25, 0, -2],
     "segment": {"shape": "box", "sbb": [[0, 0, -1], [1, 1, 0]]}},
    {"name": "right-hand", "parent": "arm", "place": [-0.25, 0, -2]},
    {"name": "thumb", "parent": "left-hand", "place": [1, 0, -0.5],
     "segment": {"shape": "box", "sbb": [[0, 0, -0.2], [0.2, 0.2, 0]]}}]})";

Model measured_model(const std::string& json) {
  const document::Document document(json, "m.json");
  return read_model(document.root());
}

Model scaled(const std::string& json, const std::string& proportions) {
  Model model = measured_model(json);
  const document::Document document(proportions, "p.json");
  apply(read_proportions(document.root()), model);
  return model;
}

void expect_near(const glm::dvec3& is, const glm::dvec3& wanted, double error = 1e-12) {
  EXPECT_LT(glm::length(is - wanted), error) << is.x << " " << is.y << " " << is.z;
}

TEST(Proportions, PatternsHaveStars) {
  EXPECT_TRUE(fits("*-thigh", "left-thigh"));
  EXPECT_TRUE(fits("left-*", "left-thigh"));
  EXPECT_TRUE(fits("l*t-*h", "left-thigh"));
  EXPECT_TRUE(fits("*", ""));
  EXPECT_TRUE(fits("**a*", "ba"));
  EXPECT_FALSE(fits("left", "left-thigh"));
  EXPECT_FALSE(fits("*-thig", "left-thigh"));
  EXPECT_FALSE(fits("a", ""));
}

TEST(Proportions, AJointScalesItsBoxAndCarriesItsChildren) {
  const Model model = scaled(kArm, R"({"joints": {"arm": [2, 1, 0.5]}, "ground": false})");
  expect_near(model.joints[0].place, {1, 1, 4});
  expect_near(model.joints[0].segment->sbb.min, {-1, -0.5, -1});
  expect_near(model.joints[0].segment->sbb.max, {1, 0.5, 0});
  expect_near(model.joints[1].place, {0.5, 0, -1});
  expect_near(model.joints[2].place, {-0.5, 0, -1});
  expect_near(model.joints[1].segment->sbb.min, {0, 0, -1});
  expect_near(model.joints[3].place, {1, 0, -0.5});
}

TEST(Proportions, ABranchScalesAllThatHangsOnIt) {
  const Model model = scaled(kArm, R"({"branches": {"left-hand": 2}, "ground": false})");
  expect_near(model.joints[0].segment->sbb.min, {-0.5, -0.5, -2});
  expect_near(model.joints[1].place, {0.25, 0, -2});
  expect_near(model.joints[1].segment->sbb.max, {2, 2, 0});
  expect_near(model.joints[3].place, {2, 0, -1});
  expect_near(model.joints[3].segment->sbb.min, {0, 0, -0.4});
}

TEST(Proportions, FactorsOfSeveralPatternsAreMultiplied) {
  const Model model = scaled(kArm, R"({"joints": {"*-hand": 2, "left*": [1, 3, 1]}, "scale": 0.5, "ground": false})");
  expect_near(model.joints[1].segment->sbb.max, {1, 3, 0});
  expect_near(model.joints[0].place, {0.5, 0.5, 2});
  expect_near(model.joints[0].segment->sbb.min, {-0.25, -0.25, -1});
}

// The lowest point is the hand's, at z = 4 - 2 - 1.
TEST(Proportions, TheLowestPointStaysAtItsHeight) {
  Model model = scaled(kArm, R"({"joints": {"left-hand": [1, 1, 3]}})");
  expect_near(model.joints[0].place, {1, 1, 6}, 1e-6);
  EXPECT_NEAR(rest_bounds(model)->min.z, 1, 1e-6);
  model = scaled(kArm, R"({"height": 6})");
  EXPECT_NEAR(rest_bounds(model)->min.z, 1, 1e-6);
  EXPECT_NEAR(rest_bounds(model)->max.z, 7, 1e-6);
  expect_near(model.joints[1].place, {0.5, 0, -4}, 1e-6);
}

// x and y at 45 degrees: in the joint's own axes the child stands at (1, 2), for 1 (1, 0) + 2 (1, 1) / sqrt 2
// is its place. Twice along y makes it (1, 4).
TEST(Proportions, GoAlongSkewedAxes) {
  const double s = std::sqrt(0.5);
  const std::string place = std::to_string(1 + 2 * s) + ", " + std::to_string(2 * s);
  const Model model = scaled(R"({"joints": [
      {"name": "a", "y_axis": [1, 1, 0], "limits": {}, "segment": {"shape": "box", "sbb": [[0, 0, 0], [1, 2, 1]]}},
      {"name": "b", "parent": "a", "place": [)" +
                                 place + R"(, 0]}]})",
                             R"({"joints": {"a": [1, 2, 1]}})");
  expect_near(model.joints[1].place, {1 + 4 * s, 4 * s, 0}, 1e-5);
  expect_near(model.joints[0].segment->sbb.max, {1, 4, 1});
}

// Where each child hangs on its parent, in the cube of the parent's segment.
std::vector<glm::dvec3> attachments(const Model& model) {
  std::vector<glm::dvec3> places;
  for (const Joint& joint : model.joints) {
    if (joint.parent == kNone || !model.joints[joint.parent].segment) continue;
    const Joint& parent = model.joints[joint.parent];
    const Box& sbb = parent.segment->sbb;
    places.push_back((glm::inverse(segment_axes(parent)) * joint.place - sbb.min) / (sbb.max - sbb.min));
  }
  return places;
}

TEST(Proportions, LimbsStayTogether) {
  const Model arm = load_model(fs::path(MARS_SOURCE_DIR) / "examples/models/robot-arm.json");
  Model other = arm;
  const document::Document document(R"({"branches": {"wrist": [1.3, 1.2, 1.4]}, "joints": {"shoulder": [1.1, 1.2, 0.7],
      "elbow": [1, 1.4, 0.8], "finger-*": [1, 2, 1]}, "height": 3})",
                                    "p.json");
  apply(read_proportions(document.root()), other);
  const auto before = attachments(arm), after = attachments(other);
  ASSERT_EQ(before.size(), arm.joints.size() - 1);
  for (std::size_t i = 0; i < before.size(); ++i) expect_near(after[i], before[i], 1e-9);
}

TEST(Proportions, AManHasTheHeightAndStandsWhereHeStood) {
  const Model man = load_model(fs::path(MARS_SOURCE_DIR) / "examples/models/human.json");
  Model other = man;
  const document::Document document(R"({"branches": {"head": [1.3, 1.2, 1.4]}, "joints": {"*-thigh": [1.1, 1.2, 0.7],
      "chest": [1, 1.4, 0.8], "*-brow": [1, 2, 1]}, "height": 3})",
                                    "p.json");
  apply(read_proportions(document.root()), other);
  EXPECT_NEAR(rest_bounds(other)->min.z, rest_bounds(man)->min.z, 1e-6);
  EXPECT_NEAR(rest_bounds(other)->max.z - rest_bounds(other)->min.z, 3, 1e-6);
  EXPECT_EQ(other.joints[3].limits[1].upper, man.joints[3].limits[1].upper);
}

class Derived : public testing::Test {
 protected:
  void SetUp() override { write("arm.json", kArm); }

  void write(const char* name, std::string_view text) { document::write_whole_file(folder_ / name, text); }
  std::string failure(const char* text) {
    write("it.json", text);
    return document::failure_of([&] { load_model(folder_ / "it.json"); });
  }

  const test::TemporaryFolder folder_;
};

TEST_F(Derived, ReadsTheOtherFileFromItsOwnFolder) {
  write("small.json", R"({"from": "arm.json", "proportions": {"scale": 0.5, "ground": false},
                          "materials": {"skin": {"color": [1, 0, 0]}}})");
  write("smaller.json", R"({"from": "small.json", "proportions": {"scale": 0.5, "ground": false}})");
  const Model model = load_model(folder_ / "smaller.json");
  expect_near(model.joints[0].segment->sbb.min, {-0.125, -0.125, -0.5});
  ASSERT_EQ(model.materials.size(), 1u);
  EXPECT_EQ(model.materials[0].name, "skin");
}

TEST_F(Derived, EveryMistakeIsOneClearError) {
  EXPECT_TRUE(
      document::holds(failure(R"({"from": "leg.json", "proportions": {}})"), "/leg.json', which does not exist"));
  EXPECT_TRUE(document::holds(failure(R"({"from": "it.json", "proportions": {}})"), "derives the model from itself"));
  EXPECT_TRUE(document::holds(failure(R"({"from": "arm.json"})"), "has no 'proportions'"));
  EXPECT_TRUE(document::holds(failure(R"({"joints": [{"name": "a"}], "proportions": {}})"), "stands without from"));
  EXPECT_TRUE(
      document::holds(failure(R"({"from": "arm.json", "proportions": {}, "joints": []})"), "stands beside from"));
  EXPECT_TRUE(document::holds(failure(R"({"from": "arm.json", "proportions": {"joints": {"left-hnd": 2}}})"),
                              "did you mean 'left-hand'?"));
  EXPECT_TRUE(document::holds(failure(R"({"from": "arm.json", "proportions": {"joints": {"arm": 0}}})"),
                              "proportions.joints.arm: is 0"));
  EXPECT_TRUE(
      document::holds(failure(R"({"from": "arm.json", "proportions": {"hight": 2}})"), "did you mean 'height'?"));
  write("other.json", R"({"from": "it.json", "proportions": {}})");
  EXPECT_TRUE(
      document::holds(failure(R"({"from": "other.json", "proportions": {}})"), "derives the model from itself"));
  write("none.json", R"({"joints": [{"name": "a"}]})");
  EXPECT_TRUE(document::holds(failure(R"({"from": "none.json", "proportions": {"height": 2}})"), "has no height"));
}

TEST(ScaleModel, ChangesPlacesAndBoxesInPlace) {
  document::Json json = document::Json::parse(kArm);
  Proportions proportions;
  proportions.joints = {{"arm", false, {2, 1, 0.5}}};
  proportions.ground = false;
  scale_model(json, measured_model(kArm), proportions);
  EXPECT_EQ(json["joints"][1]["place"].dump(), "[0.5,0,-1]");
  EXPECT_EQ(json["joints"][0]["segment"]["sbb"].dump(), "[[-1,-0.5,-1],[1,0.5,0]]");
  EXPECT_EQ(json["joints"][3], document::Json::parse(kArm)["joints"][3]);
}

TEST(ScaleModel, MultipliesTheProportionsOfADerivedModel) {
  document::Json json =
      document::Json::parse(R"({"from": "m.json", "proportions": {"joints": {"arm": 2}, "height": 3}})");
  Proportions proportions;
  proportions.joints = {{"arm", false, {1, 1, 0.5}}, {"left-hand", true, {3, 3, 3}}};
  scale_model(json, measured_model(kArm), proportions);
  EXPECT_EQ(json["proportions"].dump(), R"({"joints":{"arm":[2,2,1]},"height":3,"branches":{"left-hand":3}})");
}

}  // namespace
}  // namespace mars::modeler
