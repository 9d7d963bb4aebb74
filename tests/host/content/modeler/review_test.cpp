#include "host/content/modeler/review.h"

#include <gtest/gtest.h>

#include "host/content/modeler/model_file.h"
#include "tests/host/content/document/failure_of.h"

namespace mars::modeler {
namespace {

std::vector<std::string> doubts(const std::string& joints, const std::string& more = "") {
  const document::Document document("{\"joints\": [" + joints + "]" + more + "}", "m.json");
  return doubts_about(read_own_model(document.root()));
}

const std::string kBody = R"({"name": "body", "segment": {"shape": "box", "sbb": [[-1, -1, 0], [1, 1, 2]]}}, )";

void expect_one(const std::vector<std::string>& reported, const std::string& part) {
  ASSERT_EQ(reported.size(), 1u) << part << testing::PrintToString(reported);
  EXPECT_TRUE(document::holds(reported[0], part)) << reported[0];
}

TEST(Review, AWholeFigureIsNotDoubted) {
  EXPECT_TRUE(doubts(kBody + R"({"name": "leg", "parent": "body", "limits": {"y": [0, 9]},
      "segment": {"shape": "box", "sbb": [[0, 0, -1], [1, 1, 0]]}})")
                  .empty());
}

TEST(Review, TellsWhatIsProbablyNotMeant) {
  expect_one(doubts(kBody + R"({"name": "leg", "parent": "body", "place": [3, 0, 1],
      "segment": {"shape": "box", "sbb": [[0, 0, -1], [1, 1, 0]]}})"),
             "joint 'leg' has its segment 2 away from that of 'body' at rest");
  expect_one(doubts(kBody + R"({"name": "leg", "parent": "body", "place": [0, 0, -2],
      "segment": {"shape": "box", "sbb": [[0, 0, -1], [1, 1, 0]]}})"),
             "joint 'leg' is placed 2 outside the segment of 'body', whose sbb lies on the other side");
  expect_one(doubts(kBody + R"({"name": "leg", "parent": "body"})"), "joint 'leg' has no segment and carries no joint");
  expect_one(
      doubts(kBody + R"({"name": "leg", "parent": "body", "limits": {"y": [10, 20]}, "segment": {"shape": "box"}})"),
      "joint 'leg' rests at 10 degrees about y, for its limits leave 0 out");
  expect_one(doubts(kBody + R"({"name": "leg", "parent": "body", "segment": {"shape": "box"}},
                               {"name": "tail", "segment": {"shape": "box"}})"),
             "joint 'tail' hangs on nothing, beside 'body'");
  expect_one(doubts(R"({"name": "a", "limits": {}, "segment": {"shape": "box"}},
                       {"name": "b", "limits": {}, "parent": "a", "segment": {"shape": "box"}})"),
             "no joint can turn");
  expect_one(doubts(R"({"name": "a", "segment": {"shape": "box"}})", R"(, "materials": {"fur": {}})"),
             "material 'fur' is used by no segment");
  expect_one(doubts(R"({"name": "a", "segment": {"shape": "box", "material": "fur"}})"),
             "material 'fur' is not the model's own");
}

TEST(Review, AFloorOfTilesIsNotDoubted) {
  EXPECT_TRUE(doubts(R"({"name": "a", "limits": {}, "segment": {"shape": "box"}},
                        {"name": "b", "limits": {}, "place": [5, 0, 0], "segment": {"shape": "box"}})")
                  .empty());
}

// Legs whose hips stand at y and -y, with feet that reach forward.
std::vector<std::string> walker(double y, double root) {
  const auto leg = [&](const std::string& side, double at) {
    return R"(, {"name": ")" + side + R"(-leg", "parent": "body", "place": [0, )" + std::to_string(at) +
           R"(, -1], "segment": {"shape": "box", "sbb": [[-0.2, -0.2, -1], [0.2, 0.2, 0]]}},
           {"name": ")" +
           side + R"(-foot", "parent": ")" + side + R"(-leg", "place": [0, 0, -1],
            "segment": {"shape": "box", "sbb": [[-0.2, -0.2, 0], [0.8, 0.2, 0.1]]}})";
  };
  return doubts(R"({"name": "body", "place": [0, 0, )" + std::to_string(root) +
                    R"(], "segment": {"shape": "box", "sbb": [[-1, -1, -1], [1, 1, 1]]}})" + leg("left", y) +
                    leg("right", -y),
                R"(, "limbs": {"left": {"hip": "left-leg", "ankle": "left-foot"},
                               "right": {"hip": "right-leg", "ankle": "right-foot"}})");
}

TEST(Review, TellsFiguresThatWouldWalkBackwardOrUnderTheFloor) {
  EXPECT_TRUE(walker(0.5, 2).empty());
  expect_one(walker(0.5, 1.5), "the figure stands 0.5 under the floor, z = 0");
  expect_one(walker(0.5, 2.25), "the figure stands 0.25 over the floor");
  const std::vector<std::string> backward = walker(-0.5, 2);
  ASSERT_EQ(backward.size(), 2u);
  EXPECT_TRUE(document::holds(backward[0], "joint 'left-foot' points backward: are left and right limbs exchanged?"));
}

}  // namespace
}  // namespace mars::modeler
