// Limbs of joints without names, by how they stand.
#include <gtest/gtest.h>

#include <glm/mat3x3.hpp>

#include "host/content/importer/limbs/find_limbs.h"
#include "host/content/modeler/frames.h"
#include "tests/host/content/importer/limbs/rig.h"

namespace mars::importer {
namespace {

std::map<std::string, std::string> guessed(const Rig& rig, std::vector<std::string>* doubts = nullptr) {
  FigureTree nameless = rig.tree;
  for (TreeJoint& joint : nameless) joint.name = "";
  const FiguresLimbs found = find_limbs(nameless, {}, true);
  EXPECT_TRUE(found.is_guess);
  if (doubts != nullptr) *doubts = found.doubts;
  return names_of(rig.tree, found.limbs);
}

// The rig's joints are named as the limbs that they are.
void expect_itself(const std::map<std::string, std::string>& limbs, std::size_t count, const std::string& what) {
  for (const auto& [limb, joint] : limbs) EXPECT_EQ(limb, joint) << what;
  EXPECT_EQ(limbs.size(), count) << what;
}

TEST(LimbShape, OfPeopleHoweverTheyHoldTheirArms) {
  for (const ArmsAtRest arms : {ArmsAtRest::hang, ArmsAtRest::a_pose, ArmsAtRest::t_pose, ArmsAtRest::bent})
    expect_itself(guessed(person(arms)), 19, "arms " + std::to_string(int(arms)));
}

TEST(LimbShape, WhereverTheyLook) {
  for (const double degrees : {30.0, 90.0, 180.0, 250.0}) {
    Rig rig = person(ArmsAtRest::t_pose);
    for (TreeJoint& joint : rig.tree) joint.place = modeler::rotation_by_degrees({0, 0, 1}, degrees) * joint.place;
    expect_itself(guessed(rig), 19, std::to_string(degrees));
  }
}

// Neither feet nor knees: the figure is taken to look along -y, and the report has it.
TEST(LimbShape, WithoutFeetTheSidesAreDoubtful) {
  Rig rig = person(ArmsAtRest::t_pose), footless;
  for (TreeJoint& joint : rig.tree) {
    joint.place = modeler::rotation_by_degrees({0, 0, 1}, -90) * joint.place;
    if (joint.name.ends_with("toes") || joint.name.ends_with("tip")) continue;
    footless.add(joint.name, joint.parent == modeler::kNone ? "" : rig.tree[joint.parent].name, joint.place);
  }
  std::vector<std::string> doubts;
  expect_itself(guessed(footless, &doubts), 17, "no feet");
  ASSERT_EQ(doubts.size(), 1u);
  EXPECT_NE(doubts[0].find("which side is left"), std::string::npos) << doubts[0];
}

TEST(LimbShape, OfThingsThereAreNone) {
  Rig chain;
  chain.add("a", "", {0, 0, 0});
  for (int i = 0; i < 12; ++i) chain.add(std::to_string(i), i == 0 ? "a" : std::to_string(i - 1), {0, 0, 0.1 * i});
  EXPECT_EQ(find_limbs(chain.tree, {}, true).limbs_made, "");
  Rig star;
  star.add("a", "", {0, 0, 1});
  for (int i = 0; i < 100; ++i) star.add(std::to_string(i), "a", {0.01 * i, 0, 0});
  EXPECT_EQ(find_limbs(star.tree, {}, true).limbs_made, "");
}

}  // namespace
}  // namespace mars::importer
