// Figures of other programs walk, sit, wave and pick: a person with a skin, whose arms are held out, whose joints are
// turned anyhow and whose bones have names of Mixamo, or none.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <optional>

#include "host/content/animator/motion/body/posture.h"
#include "host/content/animator/motion/body/surface.h"
#include "host/content/animator/pose/actor_state.h"
#include "host/content/modeler/read_model.h"
#include "tests/host/content/animator/motion/bodies.h"
#include "tests/host/content/importer/glb.h"
#include "tests/host/content/importer/import_folder.h"
#include "tests/host/content/importer/limbs/rig.h"

namespace mars::importer {
namespace {

constexpr double kLeg = 0.84;                                   // from hip to ankle
constexpr double kDown = 0.003, kSlide = 0.003, kSink = 0.003;  // of it

// Canonical places in glTF's axes: y up, looking along z.
glm::dvec3 in_file(const glm::dvec3& place) { return {place.y, place.z, place.x}; }

const std::map<std::string, std::string> kMixamo = {
    {"pelvis", "Hips"},     {"spine", "Spine"},  {"rib", "Spine1"},    {"chest", "Spine2"}, {"neck", "Neck"},
    {"head", "Head"},       {"hip", "UpLeg"},    {"knee", "Leg"},      {"ankle", "Foot"},   {"toes", "ToeBase"},
    {"collar", "Shoulder"}, {"shoulder", "Arm"}, {"elbow", "ForeArm"}, {"wrist", "Hand"}};

std::string mixamo_name(const std::string& what) {
  const std::size_t dot = what.find('.');
  const auto known = kMixamo.find(dot == std::string::npos ? what : what.substr(dot + 1));
  if (known == kMixamo.end()) return what;
  const std::string side = dot == std::string::npos ? "" : what.starts_with("left") ? "Left" : "Right";
  return "mixamorig:" + side + known->second;
}

// Each joint with a turn of its own, so that its axes are no one's; around each a box of skin, the feet's on the floor.
class SkinnedRig {
 public:
  SkinnedRig(const Rig& rig, bool named) : rig_(rig) {
    for (std::size_t joint = 0; joint < rig.tree.size(); ++joint) add_node(joint, named);
    for (std::size_t joint = 1; joint < rig.tree.size(); ++joint) add_box(joint);
    add_skin();
  }

  test::Glb glb;

 private:
  static glm::dquat turn_of(std::size_t joint) {
    return glm::angleAxis(0.7 * double(joint), glm::normalize(glm::dvec3(1, double(joint % 3), 0.5)));
  }

  void add_node(std::size_t joint, bool named) {
    const TreeJoint& of = rig_.tree[joint];
    const glm::dvec3 place = in_file(of.place);
    nlohmann::json node{{"name", named ? mixamo_name(of.name) : "b" + std::to_string(joint)}};
    glm::dvec3 from(0);
    glm::dquat above(1, 0, 0, 0);
    if (of.parent != modeler::kNone) {
      from = in_file(rig_.tree[of.parent].place);
      above = turn_of(of.parent);
      glb.json["nodes"][of.parent]["children"].push_back(joint);
    }
    const glm::dvec3 step = glm::inverse(above) * (place - from);
    const glm::dquat turn = glm::inverse(above) * turn_of(joint);
    node["translation"] = {step.x, step.y, step.z};
    node["rotation"] = {turn.x, turn.y, turn.z, turn.w};
    glb.json["nodes"].push_back(node);
    const glm::dmat4 inverse = glm::inverse(glm::translate(glm::dmat4(1), place) * glm::mat4_cast(turn_of(joint)));
    for (int k = 0; k < 16; ++k) binds_.push_back(static_cast<float>(inverse[k / 4][k % 4]));
  }

  void add_box(std::size_t joint) {
    const bool is_foot = std::ranges::any_of(std::array{"ankle", "toes", "tip"},
                                             [&](const char* end) { return rig_.tree[joint].name.ends_with(end); });
    const glm::dvec3 middle = rig_.tree[joint].place;
    const double sole = middle.z - (rig_.tree[joint].name.ends_with("ankle") ? 0.08 : 0.02);
    const glm::dvec3 low(middle.x - 0.05, middle.y - 0.03, is_foot ? sole : middle.z - 0.03);
    const glm::dvec3 high(middle.x + (is_foot ? 0.08 : 0.05), middle.y + 0.03, middle.z + 0.03);
    const auto first = static_cast<std::uint8_t>(places_.size() / 3);
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec3 at =
          in_file({corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y, corner & 4 ? high.z : low.z});
      for (int k = 0; k < 3; ++k) places_.push_back(static_cast<float>(at[k]));
      bones_.insert(bones_.end(), {static_cast<std::uint8_t>(joint), 0, 0, 0});
      weights_.insert(weights_.end(), {1, 0, 0, 0});
    }
    for (const int corner : {0, 1, 2, 1, 2, 3, 4, 5, 6, 5, 6, 7, 0, 1, 4, 1, 4, 5})
      faces_.push_back(static_cast<float>(first + corner));
  }

  void add_skin() {
    std::vector<float> places;
    std::vector<std::uint8_t> bones;
    std::vector<float> weights;
    for (const float face : faces_) {
      const auto vertex = static_cast<std::size_t>(face);
      places.insert(places.end(), {places_[3 * vertex], places_[3 * vertex + 1], places_[3 * vertex + 2]});
      bones.insert(bones.end(), bones_.begin() + 4 * vertex, bones_.begin() + 4 * vertex + 4);
      weights.insert(weights.end(), weights_.begin() + 4 * vertex, weights_.begin() + 4 * vertex + 4);
    }
    const int of = glb.bytes("VEC4", bones), heavy = glb.floats("VEC4", weights);
    const int mesh = glb.triangle(places, {{"JOINTS_0", of}, {"WEIGHTS_0", heavy}});
    const int inverse = glb.floats("MAT4", binds_);
    std::vector<std::size_t> joints;
    for (std::size_t joint = 0; joint < rig_.tree.size(); ++joint) joints.push_back(joint);
    glb.json["nodes"].push_back({{"name", "skin"}, {"mesh", mesh}, {"skin", 0}});
    glb.json["skins"] = {{{"joints", joints}, {"inverseBindMatrices", inverse}}};
    glb.json["scenes"] = {{{"nodes", {std::size_t{0}, rig_.tree.size()}}}};
  }

  Rig rig_;
  std::vector<float> places_, weights_, binds_, faces_;
  std::vector<std::uint8_t> bones_;
};

class Strangers : public ImportFolder {
 protected:
  document::Json imported(ArmsAtRest arms, bool named) {
    SkinnedRig rig(person(arms), named);
    const ImportOptions options = options_for(write("figure.glb", rig.glb.file()));
    printed_ = import_model(options);
    return motion::film_with(document::read_json(options.to));
  }

  std::string printed_;
};

// What an action does to a figure, frame by frame.
class Acted {
 public:
  Acted(const document::Json& json, const motion::Performed& performed)
      : film_(motion::read(json)), model_(film_.models[0]), performed_(performed) {}

  motion::Posture at(std::uint32_t frame) const { return motion::posture_at(model_, film_.actors[0].motion, frame); }

  glm::dvec3 place(const motion::Posture& posture, modeler::Limb limb, modeler::Side side) const {
    return motion::frame_in(model_, posture, model_.limbs.of(limb, side)).place;
  }

  // Of the limb in the middle, in front of the line between the two others; of the figure's own front.
  double in_front(const motion::Posture& posture, modeler::Limb upper, modeler::Limb middle, modeler::Limb lower,
                  modeler::Side side) const {
    const glm::dvec3 left = place(posture, modeler::Limb::hip, modeler::Side::left) -
                            place(posture, modeler::Limb::hip, modeler::Side::right);
    const glm::dvec3 ahead = glm::normalize(glm::cross(left, glm::dvec3(0, 0, 1)));
    const glm::dvec3 a = place(posture, upper, side), b = place(posture, lower, side);
    const glm::dvec3 from = glm::mix(a, b, glm::distance(a, place(posture, middle, side)) / glm::distance(a, b));
    return glm::dot(place(posture, middle, side) - from, ahead);
  }

  void expect_within_limits(const std::string& what) const {
    for (std::uint32_t frame = performed_.first; frame <= performed_.last; ++frame) {
      const motion::Posture posture = at(frame);
      for (std::size_t joint = 0; joint < model_.joints.size(); ++joint)
        for (int axis = 0; axis < 3; ++axis) {
          const modeler::Limits& limits = model_.joints[joint].limits[std::size_t(axis)];
          EXPECT_GE(posture.pose[joint][axis], limits.lower - 0.01) << what << model_.joints[joint].name << frame;
          EXPECT_LE(posture.pose[joint][axis], limits.upper + 0.01) << what << model_.joints[joint].name << frame;
        }
    }
  }

  // Points of the soles that are down stay there; none goes through the floor, one foot at least is down.
  void expect_footing(const std::string& what, std::uint32_t later = 0) const {
    double slid = 0, sunk = 0, floating = 0;
    std::vector<std::optional<glm::dvec3>> landed;
    for (std::uint32_t frame = performed_.first + later; frame <= performed_.last; ++frame) {
      const std::vector<glm::dvec3> points = soles(at(frame));
      landed.resize(points.size());
      double least = 1e9;
      for (std::size_t i = 0; i < points.size(); ++i) {
        least = std::min(least, points[i].z / kLeg);
        if (points[i].z > kDown * kLeg) {
          landed[i].reset();
          continue;
        }
        if (!landed[i]) landed[i] = points[i];
        slid = std::max(slid, std::hypot(points[i].x - landed[i]->x, points[i].y - landed[i]->y) / kLeg);
      }
      sunk = std::max(sunk, -least);
      floating = std::max(floating, least);
    }
    EXPECT_LT(slid, kSlide) << what;
    EXPECT_LT(sunk, kSink) << what;
    EXPECT_LT(floating, kDown) << what;
  }

  const motion::Performed& performed() const { return performed_; }
  const animator::Film& film() const { return film_; }

 private:
  std::vector<glm::dvec3> soles(const motion::Posture& posture) const {
    return motion::points_of(model_, posture, [&](std::size_t joint) {
      return modeler::is_at_or_below(model_.joints, joint,
                                     model_.limbs.of(modeler::Limb::ankle, modeler::Side::left)) ||
             modeler::is_at_or_below(model_.joints, joint, model_.limbs.of(modeler::Limb::ankle, modeler::Side::right));
    });
  }

  animator::Film film_;
  const modeler::Model& model_;
  motion::Performed performed_;
};

using modeler::Limb;

TEST_F(Strangers, Walk) {
  for (const bool named : {true, false})
    for (const ArmsAtRest arms : {ArmsAtRest::t_pose, ArmsAtRest::a_pose, ArmsAtRest::bent}) {
      document::Json film = imported(arms, named);
      const std::string what = (named ? "Mixamo, arms " : "no names, arms ") + std::to_string(int(arms));
      EXPECT_NE(printed_.find(named ? "19 limbs by the names of Mixamo" : "19 limbs, guessed by"), std::string::npos)
          << printed_;
      const motion::Performed performed = motion::act(film, "walk steps 4", 0);
      const Acted acted(film, performed);
      acted.expect_footing(what);
      acted.expect_within_limits(what);
      for (std::uint32_t frame = performed.first; frame <= performed.last; ++frame) {
        const motion::Posture posture = acted.at(frame);
        for (const modeler::Side side : {modeler::Side::left, modeler::Side::right}) {
          EXPECT_GT(acted.in_front(posture, Limb::hip, Limb::knee, Limb::ankle, side), -0.001) << what << frame;
          if (frame < performed.first + 15) continue;  // until the arms have come down
          EXPECT_LT(acted.in_front(posture, Limb::shoulder, Limb::elbow, Limb::wrist, side), 0.001) << what << frame;
          EXPECT_LT(acted.place(posture, Limb::wrist, side).z, acted.place(posture, Limb::shoulder, side).z - 0.35)
              << what << ": arms hang, frame " << frame;
        }
      }
    }
}

// One leg is drawn 8 mm shorter: the walk brings both feet to the floor, in its first frames.
TEST_F(Strangers, WalkOnUnequalLegs) {
  Rig uneven = person(ArmsAtRest::t_pose);
  for (TreeJoint& joint : uneven.tree)
    if (joint.name.starts_with("left.") && joint.place.z < 0.09) joint.place.z += 0.008;
  SkinnedRig rig(uneven, true);
  const ImportOptions options = options_for(write("figure.glb", rig.glb.file()));
  import_model(options);
  document::Json film = motion::film_with(document::read_json(options.to));
  const motion::Performed performed = motion::act(film, "walk steps 3", 0);
  Acted(film, performed).expect_footing("unequal legs", 8);
}

TEST_F(Strangers, SitDownAndStandUp) {
  document::Json film = imported(ArmsAtRest::t_pose, true);
  const motion::Performed sits = motion::act(film, "sit", 0);
  const Acted sitting(film, sits);
  sitting.expect_footing("sit");
  sitting.expect_within_limits("sit");
  const motion::Posture seated = sitting.at(sits.last);
  for (const modeler::Side side : {modeler::Side::left, modeler::Side::right}) {
    EXPECT_LT(std::abs(sitting.place(seated, Limb::hip, side).z - sitting.place(seated, Limb::knee, side).z), 0.12);
    EXPECT_LT(sitting.place(seated, Limb::wrist, side).z - sitting.place(seated, Limb::knee, side).z, 0.25)
        << "its hands are on its thighs";
  }
  const motion::Performed stands = motion::act(film, "stand");
  Acted(film, stands).expect_within_limits("stand");
}

TEST_F(Strangers, Wave) {
  document::Json film = imported(ArmsAtRest::a_pose, false);
  const motion::Performed waves = motion::act(film, "wave hand left", 0);
  const Acted acted(film, waves);
  acted.expect_within_limits("wave");
  const motion::Posture up = acted.at((waves.first + waves.last) / 2);
  EXPECT_GT(acted.place(up, Limb::wrist, modeler::Side::left).z,
            acted.place(up, Limb::shoulder, modeler::Side::left).z + 0.15);
}

TEST_F(Strangers, PickUpABall) {
  document::Json film = imported(ArmsAtRest::t_pose, true);
  motion::act(film, "walk steps 2", 0);
  film["models"]["ball"] = {
      {"joints",
       {{{"name", "ball"}, {"segment", {{"shape", "sphere"}, {"sbb", {{-0.05, -0.05, -0.05}, {0.05, 0.05, 0.05}}}}}}}}};
  const Acted before(film, {});
  const motion::Posture stands = before.at(999);
  const glm::dvec3 feet = before.place(stands, Limb::ankle, modeler::Side::right);
  const glm::dvec3 toes = before.place(stands, Limb::toes, modeler::Side::right);
  const glm::dvec3 ball = feet + 2.5 * (toes - feet);
  film["actors"].push_back({{"name", "ball"}, {"model", "ball"}, {"place", {ball.x, ball.y, 0.05}}});
  const motion::Performed picks = motion::act(film, "pick what ball hand right");
  const Acted acted(film, picks);
  acted.expect_footing("pick");
  acted.expect_within_limits("pick");
  const glm::dvec3 held = animator::state_at(acted.film(), 1, picks.last).root.place;
  EXPECT_GT(held.z, 0.3) << "it is off the floor";
  EXPECT_LT(glm::distance(held, acted.place(acted.at(picks.last), Limb::wrist, modeler::Side::right)), 0.3);
}

// The file's own map counts, whatever the names are.
TEST_F(Strangers, MapsOfVrm) {
  for (const bool new_version : {true, false}) {
    const Rig figure = person(ArmsAtRest::t_pose);
    SkinnedRig rig(figure, false);
    nlohmann::json bones = new_version ? nlohmann::json::object() : nlohmann::json::array();
    for (const auto& [limb, bone] : std::map<std::string, std::string>{{"pelvis", "hips"},
                                                                       {"head", "head"},
                                                                       {"left.hip", "leftUpperLeg"},
                                                                       {"left.knee", "leftLowerLeg"},
                                                                       {"left.ankle", "leftFoot"},
                                                                       {"right.hip", "rightUpperLeg"},
                                                                       {"right.knee", "rightLowerLeg"},
                                                                       {"right.ankle", "rightFoot"}}) {
      const std::size_t node = figure.joints.at(limb);
      if (new_version)
        bones[bone] = {{"node", node}};
      else
        bones.push_back({{"bone", bone}, {"node", node}});
    }
    const std::string extension = new_version ? "VRMC_vrm" : "VRM";
    rig.glb.json["extensionsUsed"] = {extension};
    rig.glb.json["extensions"][extension]["humanoid"]["humanBones"] = bones;
    const ImportOptions options = options_for(write(new_version ? "figure.vrm" : "figure.glb", rig.glb.file()));
    const std::string printed = import_model(options);
    EXPECT_NE(printed.find("limbs by the map of " + extension), std::string::npos) << printed;
    EXPECT_NE(printed.find("not found: left.shoulder"), std::string::npos) << printed;
    const document::Json limbs = document::read_json(options.to)["limbs"];
    EXPECT_EQ(limbs["left"]["knee"], "b" + std::to_string(figure.joints.at("left.knee")));
    EXPECT_EQ(limbs["head"], "b" + std::to_string(figure.joints.at("head")));
    EXPECT_FALSE(limbs["left"].contains("shoulder"));
  }
}

TEST_F(Strangers, LookAhead) {
  ImportOptions options = options_for(write("figure.glb", SkinnedRig(person(ArmsAtRest::t_pose), true).glb.file()));
  options.front = "z";
  EXPECT_EQ(import_model(options).find("turned to look"), std::string::npos);
  const document::Json given = document::read_json(options.to);
  options.front.clear();
  options.force = true;
  const std::string printed = import_model(options);
  EXPECT_NE(printed.find("turned to look along x (--front z)"), std::string::npos) << printed;
  EXPECT_EQ(document::read_json(options.to), given);
}

}  // namespace
}  // namespace mars::importer
