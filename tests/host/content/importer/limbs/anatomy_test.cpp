// Limits of limbs: at each of them the limb stands where people's joints end, however the figure holds its arms at
// rest.
#include <gtest/gtest.h>

#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include "host/content/importer/limbs/anatomy.h"
#include "host/content/importer/limbs/find_limbs.h"
#include "host/content/modeler/frames.h"
#include "tests/host/content/importer/limbs/rig.h"

namespace mars::importer {
namespace {

constexpr double kDegrees = 1.01;  // limits are whole degrees, and so may be what they are counted from

class Limbed {
 public:
  explicit Limbed(const Rig& rig) : rig_(rig) {
    for (TreeJoint& joint : rig_.tree) joint.name = "";
    limbs_ = find_limbs(rig_.tree, {}, true);
  }

  const JointAnatomy& anatomy(const std::string& limb) const { return *limbs_.anatomy[rig_.joints.at(limb)]; }
  bool has(const std::string& limb) const { return limbs_.anatomy[rig_.joints.at(limb)].has_value(); }

  // The direction from a joint to another, when the first has turned about one of its axes alone.
  glm::dvec3 turned(const std::string& limb, int axis, double degrees, const std::string& to) const {
    const glm::dmat3& axes = anatomy(limb).axes;
    const glm::dvec3 bone = rig_.tree[rig_.joints.at(to)].place - rig_.tree[rig_.joints.at(limb)].place;
    return modeler::rotation_by_degrees(axes[axis], degrees) * glm::normalize(bone);
  }

  double limit(const std::string& limb, int axis, bool upper) const {
    const modeler::Limits& limits = (*anatomy(limb).limits)[static_cast<std::size_t>(axis)];
    return upper ? limits.upper : limits.lower;
  }

 private:
  Rig rig_;
  FiguresLimbs limbs_;
};

// Where a bone points that is so far forward of hanging, or out to the left.
glm::dvec3 forward(double degrees) { return {std::sin(glm::radians(degrees)), 0, -std::cos(glm::radians(degrees))}; }
glm::dvec3 leftward(double degrees) { return {0, std::sin(glm::radians(degrees)), -std::cos(glm::radians(degrees))}; }

struct Ending {
  const char *limb, *to;
  int axis;
  bool upper;
  glm::dvec3 direction;
};

void expect_endings(const Limbed& figure, const std::vector<Ending>& endings, const std::string& what) {
  for (const Ending& ending : endings) {
    const double limit = figure.limit(ending.limb, ending.axis, ending.upper);
    const glm::dvec3 is = figure.turned(ending.limb, ending.axis, limit, ending.to);
    const double off = glm::degrees(std::acos(std::min(1.0, glm::dot(is, glm::normalize(ending.direction)))));
    EXPECT_LT(off, kDegrees) << what << ": " << ending.limb << " at " << limit << " about "
                             << "xyz"[ending.axis];
  }
}

// American Academy of Orthopaedic Surgeons, 1965; hips and knees of the CDC's study.
TEST(Anatomy, LegsEndWhereJointsOfPeopleDo) {
  const Limbed figure(person(ArmsAtRest::t_pose));
  expect_endings(figure,
                 {{"left.hip", "left.knee", 1, false, forward(132)},
                  {"left.hip", "left.knee", 1, true, forward(-30)},
                  {"left.hip", "left.knee", 0, true, leftward(45)},
                  {"left.hip", "left.knee", 0, false, leftward(-30)},
                  {"right.hip", "right.knee", 0, false, leftward(-45)},
                  {"right.hip", "right.knee", 0, true, leftward(30)},
                  {"left.knee", "left.ankle", 1, true, forward(-140)},
                  {"left.knee", "left.ankle", 1, false, forward(0)}},
                 "legs");
  for (const int axis : {0, 2}) EXPECT_FALSE((*figure.anatomy("left.knee").limits)[std::size_t(axis)].free());
}

TEST(Anatomy, ArmsEndWhereJointsOfPeopleDoHoweverTheyAreHeld) {
  for (const ArmsAtRest arms : {ArmsAtRest::hang, ArmsAtRest::a_pose, ArmsAtRest::t_pose}) {
    const Limbed figure(person(arms));
    const std::string what = "arms " + std::to_string(int(arms));
    expect_endings(figure,
                   {{"left.shoulder", "left.elbow", 0, true, leftward(180)},
                    {"left.shoulder", "left.elbow", 0, false, leftward(-50)},
                    {"right.shoulder", "right.elbow", 0, false, leftward(-180)},
                    {"right.shoulder", "right.elbow", 0, true, leftward(50)}},
                   what);
    for (const std::string side : {"left.", "right."}) {
      const double bent = figure.limit(side + "elbow", 1, false);
      EXPECT_EQ(bent, -150) << what;
      EXPECT_EQ(figure.limit(side + "elbow", 1, true), 0) << what << ": elbows do not bend back";
      EXPECT_GT(figure.turned(side + "elbow", 1, -90, side + "wrist").x, 0.999) << what << ": they bend to the front";
    }
  }
}

// Of an elbow that is bent at rest, what is left.
TEST(Anatomy, BentElbowsBendOn) {
  const Limbed figure(person(ArmsAtRest::bent));
  for (const std::string side : {"left.", "right."}) {
    const double straight = figure.limit(side + "elbow", 1, true);
    EXPECT_GT(straight, 20);
    EXPECT_EQ(figure.limit(side + "elbow", 1, false), straight - 150);
    const glm::dvec3 upper = figure.turned(side + "shoulder", 0, 0, side + "elbow");
    EXPECT_GT(glm::dot(figure.turned(side + "elbow", 1, straight, side + "wrist"), upper), 0.999);
  }
}

TEST(Anatomy, FeetHandsAndTrunk) {
  const Limbed figure(person(ArmsAtRest::hang));
  const auto range = [&](const char* limb, int axis) {
    return std::pair(figure.limit(limb, axis, false), figure.limit(limb, axis, true));
  };
  EXPECT_EQ(range("left.ankle", 1), std::pair(-40.0, 50.0));
  EXPECT_EQ(range("left.ankle", 0), std::pair(-35.0, 15.0));
  EXPECT_EQ(range("right.ankle", 0), std::pair(-15.0, 35.0));
  EXPECT_EQ(range("left.toes", 1), std::pair(-70.0, 45.0));
  EXPECT_EQ(range("left.wrist", 0), std::pair(-80.0, 70.0));
  EXPECT_EQ(range("right.wrist", 0), std::pair(-70.0, 80.0));
  EXPECT_EQ(range("left.shoulder", 2), std::pair(-70.0, 90.0));
  EXPECT_EQ(range("right.shoulder", 2), std::pair(-90.0, 70.0));
  for (const char* part : {"spine", "rib", "chest"})
    EXPECT_EQ(range(part, 1), std::pair(-10.0, 27.0)) << "a third of the back's";
  EXPECT_EQ(range("neck", 2), std::pair(-30.0, 30.0)) << "half of the neck's";
  EXPECT_EQ(range("left.collar", 0), std::pair(-10.0, 40.0));
  EXPECT_EQ(range("right.collar", 0), std::pair(-40.0, 10.0));
  EXPECT_EQ(range("left.twist", 2), std::pair(-80.0, 80.0));
  EXPECT_EQ(range("left.twist", 1), std::pair(0.0, 0.0)) << "a thigh does not bend";
  EXPECT_FALSE(figure.anatomy("pelvis").limits.has_value()) << "it turns with the figure";
  EXPECT_FALSE(figure.has("left.tip"));
}

TEST(Anatomy, FourLegsAreNoPeoples) {
  Rig rig = person(ArmsAtRest::hang);
  for (TreeJoint& joint : rig.tree)
    if (joint.name.find("wrist") != std::string::npos || joint.name.find("finger") != std::string::npos)
      joint.place.z = 0.05;
  const Limbed figure(rig);
  EXPECT_FALSE(figure.anatomy("left.hip").limits.has_value());
  EXPECT_FALSE(figure.anatomy("left.elbow").limits.has_value());
}

}  // namespace
}  // namespace mars::importer
