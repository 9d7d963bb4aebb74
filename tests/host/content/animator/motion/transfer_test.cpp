// Motions put on other figures: the same one moves as before, another one points its limbs the same way at the same
// time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "host/content/animator/motion/body/body.h"
#include "host/content/animator/motion/transfer/matching.h"
#include "host/content/animator/motion/transfer/transfer.h"
#include "host/content/animator/pose/joint_frames.h"
#include "tests/host/content/animator/motion/strangers.h"
#include "tests/host/content/document/failure_of.h"

namespace mars::motion {
namespace {

using modeler::Limb;

struct Bone {
  Limb from, to;
};
constexpr Bone kBones[] = {
    {Limb::hip, Limb::knee}, {Limb::knee, Limb::ankle}, {Limb::shoulder, Limb::elbow}, {Limb::elbow, Limb::wrist}};

document::Json dance(const document::Json& model) {
  document::Json json = film_with(model);
  act(json, "walk steps 3", 0);
  act(json, "wave hand left times 1");
  act(json, "turn by 60");
  return json;
}

Transferred put(const document::Json& from, document::Json& to, std::uint32_t at = 0) {
  const animator::Film source = read(from), target = read(to);
  const std::uint32_t last = animator::last_key(source.actors[0].motion);
  Transferred done = transfer_motion({source, 0, {0, last}}, target, 0, at);
  animator::put_keys(to, "anna", done.keys);
  return done;
}

double angle(const glm::dmat3& a, const glm::dmat3& b) { return glm::degrees(animator::turn_between(a, b).angle); }

glm::dvec3 direction(const animator::Film& film, const Bone& bone, modeler::Side side, std::uint32_t frame) {
  animator::JointFrames frames(film);
  const modeler::Limbs& limbs = film.models[film.actors[0].model].limbs;
  return glm::normalize(frames.frame_of(0, limbs.of(bone.to, side), frame).place -
                        frames.frame_of(0, limbs.of(bone.from, side), frame).place);
}

TEST(Transfer, TheSameFigureMovesAsBefore) {
  const document::Json from = dance(human());
  document::Json to = film_with(human());
  const Transferred done = put(from, to);
  EXPECT_TRUE(done.limited.empty());
  EXPECT_TRUE(done.left_out.empty());
  EXPECT_DOUBLE_EQ(done.scale, 1);
  const animator::Film before = read(from), after = read(to);
  animator::JointFrames a(before), b(after);
  for (std::uint32_t frame = 0; frame <= done.last; ++frame)
    for (std::size_t joint = 0; joint < before.models[0].joints.size(); ++joint) {
      const modeler::Axes was = a.frame_of(0, joint, frame), is = b.frame_of(0, joint, frame);
      ASSERT_LT(angle(was.turn, is.turn), 0.01) << frame << " " << before.models[0].joints[joint].name;
      ASSERT_LT(glm::distance(was.place, is.place), 1e-3) << frame;
    }
}

// Arms held out in one model hang in the other, and its back has a joint more.
TEST(Transfer, LimbsOfAnotherFigurePointTheSameWay) {
  for (const bool to_stranger : {false, true}) {
    const document::Json from = dance(to_stranger ? human() : stranger());
    document::Json to = film_with(to_stranger ? stranger() : human());
    const Transferred done = put(from, to);
    EXPECT_GT(done.by_limb, 14u);
    const animator::Film before = read(from), after = read(to);
    for (const Limited& limited : done.limited) EXPECT_LT(limited.degrees, 30) << limited.joint;
    for (std::uint32_t frame = 0; frame <= done.last; frame += 5)
      for (const modeler::Side side : kSides)
        for (const Bone& bone : kBones) {
          const double cosine = glm::dot(direction(before, bone, side, frame), direction(after, bone, side, frame));
          const auto& name = after.models[0].joints[after.models[0].limbs.of(bone.from, side)].name;
          const bool limited = std::ranges::find(done.limited, name, &Limited::joint) != done.limited.end();
          EXPECT_GT(cosine, std::cos(glm::radians(limited ? 25.0 : 1.0))) << to_stranger << " " << frame << " " << name;
        }
  }
}

// The hips go as far as they are high.
TEST(Transfer, WaysGoByTheHeightsOfTheHips) {
  const document::Json from = dance(human());
  document::Json to = film_with(built(0.6, 0.85, 1.05));
  const Transferred done = put(from, to);
  const animator::Film before = read(from), after = read(to);
  animator::JointFrames a(before), b(after);
  const auto way = [&](animator::JointFrames& frames, const animator::Film& film) {
    const std::size_t pelvis = film.models[0].limbs.of(modeler::Trunk::pelvis);
    return glm::distance(glm::dvec2(frames.frame_of(0, pelvis, 0).place),
                         glm::dvec2(frames.frame_of(0, pelvis, done.last).place));
  };
  EXPECT_LT(done.scale, 0.6);
  EXPECT_NEAR(way(b, after), done.scale * way(a, before), 1e-6);
}

TEST(Transfer, KeepsItsTimesAtAnotherRate) {
  document::Json from = dance(human()), to = film_with(human());
  from["rate"] = 30;
  const Transferred done = put(from, to, 8);
  const animator::Film before = read(from), after = read(to);
  EXPECT_EQ(done.first, 8u);
  EXPECT_EQ(done.last, 8 + animator::last_key(before.actors[0].motion) * 24 / 30);
  animator::JointFrames a(before), b(after);
  for (std::uint32_t k = 0; 8 + 4 * k <= done.last; ++k)
    for (std::size_t joint = 0; joint < before.models[0].joints.size(); ++joint)
      ASSERT_LT(angle(a.frame_of(0, joint, 5 * k).turn, b.frame_of(0, joint, 8 + 4 * k).turn), 0.01) << k;
}

TEST(Transfer, MatchesNamesWithoutPrefixesAndNamesWhatIsLeft) {
  document::Json one = stranger(), other = stranger();
  for (document::Json& joint : other["joints"])
    if (joint["name"] == "spine1" || joint.value("parent", "") == "spine1")
      for (const char* key : {"name", "parent"})
        if (joint[key] == "spine1") joint[key] = "mixamorig:Spine1";
  document::Json from = film_with(one), to = film_with(other);
  from["actors"][0]["keys"] = document::Json::parse(
      R"([{"frame": 0, "pose": {"spine1": [0, 0, 0]}}, {"frame": 9, "pose": {"spine1": [0, 20, 0]}}])");
  EXPECT_EQ(put(from, to).by_name, 3u);  // and the collarbones
  document::Json man = film_with(human());
  const Transferred left = put(from, man);
  ASSERT_EQ(left.left_out.size(), 1u);
  EXPECT_EQ(left.left_out[0], "spine1");
}

TEST(Transfer, RefusesFiguresThatHaveNothingInCommon) {
  document::Json from = dance(human()), to = film_with(document::Json::parse(R"({"joints": [{"name": "box"}]})"));
  EXPECT_NE(document::failure_of([&] { put(from, to); }).find("no joint that stands for one"), std::string::npos);
}

}  // namespace
}  // namespace mars::motion
