// Our figures, each joint of the middle and of the left side bent to each of its limits: their surfaces stay whole and
// smooth, where their control points are, and keep their insides.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "host/content/modeler/bent_skin.h"
#include "host/content/modeler/frames.h"
#include "host/content/modeler/read_model.h"
#include "tests/host/content/modeler/surface.h"

namespace mars::modeler {
namespace {

// Degrees between normals of neighbours, at most.
constexpr double kSmooth = 0.5;      // where four patches meet at each corner of both
constexpr double kAnywhere = 5.5;    // along all that any two share
constexpr double kAtRest = 3.8;      // the same at rest
constexpr double kInWebs = 65;       // the same in webs, when fingers are spread to their limits
constexpr double kMostVolume = 1.4;  // of a surface, bent, to what it is at rest; and the least the other way round

// Frames of all joints with one turned by `pose`.
std::vector<Axes> posed_frames(const Model& model, std::size_t turned, const glm::dvec3& pose) {
  std::vector<Axes> frames;
  for (std::size_t number = 0; number < model.joints.size(); ++number) {
    const Joint& joint = model.joints[number];
    const Axes from = joint.parent == kNone ? Axes{} : frames[joint.parent];
    const glm::dmat3 turn = orientation(joint, number == turned ? pose : joint.rest());
    frames.push_back({from.turn * turn, from.place + from.turn * joint.place});
  }
  return frames;
}

BentSkin bent(const Joint& joint, const std::vector<Axes>& frames) {
  std::vector<wire::Matrix> bones;
  for (const Bone& bone : joint.segment->bones) bones.push_back(bone_matrix(frames[bone.joint], bone, joint));
  return BentSkin(std::move(bones), joint.segment->blend);
}

// A side of a patch, by the numbers of its corners; and where it is.
struct HemSide {
  std::size_t patch;
  int side;
};

Edge side_of(const wire::Patch& patch, int side) {
  const std::array<Edge, 4> sides = sides_of(patch);
  return sides[static_cast<std::size_t>(side)];
}

glm::dvec3 normal_on(const wire::Patch& patch, int side, double along) {
  const double uv[4][2] = {{along, 0}, {1, along}, {1 - along, 1}, {0, 1 - along}};
  return normal_of(patch, uv[side][0], uv[side][1]);
}

double degrees_between(const glm::dvec3& a, const glm::dvec3& b) {
  return std::acos(std::clamp(glm::dot(glm::normalize(a), glm::normalize(b)), -1.0, 1.0)) / kDegree;
}

// What a surface is at rest: which sides join, and which joins must be smooth.
class Surface {
 public:
  explicit Surface(const std::vector<wire::Patch>& patches) {
    std::map<Edge, HemSide> sides;
    for (std::size_t patch = 0; patch < patches.size(); ++patch)
      for (int side = 0; side < 4; ++side) {
        const Edge edge = side_of(patches[patch], side);
        ++corners_[edge[0]];
        Edge reversed = edge;
        std::reverse(reversed.begin(), reversed.end());
        if (const auto other = sides.find(reversed); other != sides.end()) {
          joins_.push_back({{patch, side}, other->second});
          sides.erase(other);
        } else {
          sides[edge] = {patch, side};
        }
      }
    classify_joins(patches);
    for (const auto& [edge, side] : sides) rims_[edge[0]] = {side, edge[3]};
    while (!rims_.empty()) hems_.push_back(taken_loop());
  }

  // Loops of sides that no other patch has.
  std::size_t hems() const { return hems_.size(); }

  // Sides that join at rest and not now.
  std::size_t cracks(const std::vector<wire::Patch>& now) const {
    return static_cast<std::size_t>(std::ranges::count_if(joins_, [&](const Join& join) {
      Edge one = side_of(now[join.one.patch], join.one.side);
      std::ranges::reverse(one);
      return one != side_of(now[join.other.patch], join.other.side);
    }));
  }

  // The greatest jump of the normal, in degrees, between sides at both of whose ends four patches meet: where they do
  // so at the other corners of both patches, or do not.
  double jump(const std::vector<wire::Patch>& now, bool at_other_corners) const {
    double most = 0;
    for (const Join& join : joins_) {
      if (!join.between_fours || join.is_regular != at_other_corners) continue;
      most = std::max(most, degrees_between(normal_on(now[join.one.patch], join.one.side, 0.4),
                                            normal_on(now[join.other.patch], join.other.side, 0.6)));
    }
    return most;
  }

  // The same between all patches, at seven places of each side.
  double jump_anywhere(const std::vector<wire::Patch>& now) const {
    double most = 0;
    for (const Join& join : joins_)
      for (int place = 0; place <= 6; ++place)
        most = std::max(most, degrees_between(normal_on(now[join.one.patch], join.one.side, place / 6.0),
                                              normal_on(now[join.other.patch], join.other.side, 1 - place / 6.0)));
    return most;
  }

  // With its hems closed; below 0 if it is inside out.
  double volume(const std::vector<wire::Patch>& now) const {
    constexpr int kSteps = 2;
    double volume = 0;
    for (const wire::Patch& patch : now)
      for (int j = 0; j < kSteps; ++j)
        for (int i = 0; i < kSteps; ++i) {
          const double u = (i + 0.5) / kSteps, v = (j + 0.5) / kSteps;
          volume += glm::dot(point_of(patch, u, v), normal_of(patch, u, v)) / (3.0 * kSteps * kSteps);
        }
    for (const std::vector<HemSide>& hem : hems_) volume += lid(now, hem);
    return volume;
  }

 private:
  struct Join {
    HemSide one, other;
    bool between_fours = false;  // four patches meet at both of its ends
    bool is_regular = false;     // and at the other corners of both patches, but for hems
  };
  struct Rim {
    HemSide side;
    Point to;
  };

  void classify_joins(const std::vector<wire::Patch>& patches) {
    std::vector<bool> is_regular;
    for (const wire::Patch& patch : patches)
      is_regular.push_back(std::ranges::none_of(sides_of(patch), [&](const Edge& edge) {
        const int meet = corners_.at(edge[0]);
        return meet == 3 || meet > 4;  // 2 or 1 at a hem
      }));
    for (Join& join : joins_) {
      const Edge edge = side_of(patches[join.one.patch], join.one.side);
      join.between_fours = corners_.at(edge[0]) == 4 && corners_.at(edge[3]) == 4;
      join.is_regular = is_regular[join.one.patch] && is_regular[join.other.patch];
    }
  }

  std::vector<HemSide> taken_loop() {
    std::vector<HemSide> loop;
    for (auto at = rims_.begin(); at != rims_.end();) {
      const Rim rim = at->second;
      loop.push_back(rim.side);
      rims_.erase(at);
      at = rims_.find(rim.to);
    }
    return loop;
  }

  // Cones from the hem's middle to its sides, seen from outside.
  static double lid(const std::vector<wire::Patch>& now, const std::vector<HemSide>& hem) {
    glm::dvec3 middle(0);
    const auto corner = [&](const HemSide& side, std::size_t end) {
      const Edge edge = side_of(now[side.patch], side.side);
      return glm::dvec3(edge[end][0], edge[end][1], edge[end][2]);
    };
    for (const HemSide& side : hem) middle += corner(side, 0) / static_cast<double>(hem.size());
    double volume = 0;
    for (const HemSide& side : hem) volume += glm::dot(middle, glm::cross(corner(side, 3), corner(side, 0))) / 6;
    return volume;
  }

  std::vector<Join> joins_;
  std::map<Point, Rim> rims_;
  std::vector<std::vector<HemSide>> hems_;
  std::map<Point, int> corners_;  // how many patches meet there
};

struct Bounds {
  glm::dvec3 min{1e9}, max{-1e9};

  void grow(const glm::dvec3& point) {
    min = glm::min(min, point);
    max = glm::max(max, point);
  }
};

// Of the skin's control points.
Bounds bounds_of(const Model& model, const Joint& joint, const BentSkin& skin) {
  const ControlNet& net = *model.shapes[joint.segment->shape].net;
  Bounds bounds;
  for (std::size_t point = 0; point < net.points.size(); ++point)
    bounds.grow(skin.place_of(net.points[point], net.bones[point]));
  return bounds;
}

// How far the surface is beyond its control points, of which bounds of skins are made.
double beyond(const Bounds& bounds, const std::vector<wire::Patch>& now) {
  double most = 0;
  for (const wire::Patch& patch : now)
    for (const Point& p : patch.points)
      for (int axis = 0; axis < 3; ++axis) {
        const double at = p[static_cast<std::size_t>(axis)];
        most = std::max({most, bounds.min[axis] - at, at - bounds.max[axis]});
      }
  return most;
}

// A segment with a skin: its surface at rest, and what it must be wherever its bones go.
struct Skin {
  const Joint* joint;
  Surface surface;
  double volume;
};

Skin skin_of(const Model& model, const Joint& joint) {
  const std::vector<wire::Patch> patches =
      bent(joint, posed_frames(model, kNone, {})).patches_of(*model.shapes[joint.segment->shape].net);
  const Surface surface(patches);
  return {&joint, surface, surface.volume(patches)};
}

bool follows(const Model& model, const Joint& joint, std::size_t turned) {
  return std::ranges::any_of(joint.segment->bones,
                             [&](const Bone& bone) { return is_at_or_below(model.joints, bone.joint, turned); });
}

void check(const Model& model, const Skin& skin, const std::vector<Axes>& frames, const std::string& pose,
           bool is_of_finger) {
  const BentSkin skinned = bent(*skin.joint, frames);
  const std::vector<wire::Patch> now = skinned.patches_of(*model.shapes[skin.joint->segment->shape].net);
  EXPECT_LT(beyond(bounds_of(model, *skin.joint, skinned), now), 1e-5) << pose;
  EXPECT_EQ(skin.surface.cracks(now), 0u) << pose;
  EXPECT_LT(skin.surface.jump(now, true), kSmooth) << pose;
  EXPECT_LT(skin.surface.jump(now, false), kAnywhere) << pose;
  EXPECT_LT(skin.surface.jump_anywhere(now), is_of_finger ? kInWebs : kAnywhere) << pose;
  const double volume = skin.surface.volume(now) / skin.volume;
  EXPECT_GT(volume, 1 / kMostVolume) << pose;
  EXPECT_LT(volume, kMostVolume) << pose;
}

class FiguresBend : public testing::TestWithParam<std::tuple<const char*, std::map<std::string, std::size_t>>> {};

bool is_finger(const std::string& joint) {
  return std::ranges::any_of(std::array{"-thumb-", "-index-", "-middle-", "-ring-", "-little-"},
                             [&](const char* digit) { return joint.find(digit) != std::string::npos; });
}

TEST_P(FiguresBend, ToEveryLimitWithoutCracksOrLines) {
  const auto& [name, hems] = GetParam();
  const Model model = load_model(std::filesystem::path(MARS_SOURCE_DIR) / "examples/models" / name);
  std::vector<Skin> skins;
  std::map<std::string, std::size_t> found;
  for (const Joint& joint : model.joints)
    if (joint.segment && !joint.segment->bones.empty()) {
      skins.push_back(skin_of(model, joint));
      EXPECT_GT(skins.back().volume, 0) << joint.name;
      found[model.shapes[joint.segment->shape].name] = skins.back().surface.hems();
    }
  EXPECT_EQ(found, hems);
  for (const Skin& skin : skins) {
    const ControlNet& net = *model.shapes[skin.joint->segment->shape].net;
    EXPECT_LT(skin.surface.jump_anywhere(bent(*skin.joint, posed_frames(model, kNone, {})).patches_of(net)), kAtRest)
        << skin.joint->name;
  }
  std::size_t poses = 0;
  for (std::size_t turned = 0; turned < model.joints.size(); ++turned) {
    if (model.joints[turned].name.starts_with("right-")) continue;  // as the left ones, in a mirror
    for (int axis = 0; axis < 3; ++axis) {
      const Limits& limits = model.joints[turned].limits[static_cast<std::size_t>(axis)];
      if (!limits.free()) continue;
      for (const double angle : {limits.lower, limits.upper}) {
        glm::dvec3 pose(0);
        pose[axis] = angle;
        const std::vector<Axes> frames = posed_frames(model, turned, pose);
        const std::string words = model.joints[turned].name + " " + "xyz"[axis] + " " + std::to_string(int(angle));
        for (const Skin& skin : skins)
          if (follows(model, *skin.joint, turned))
            check(model, skin, frames, words + ": " + skin.joint->name, is_finger(model.joints[turned].name));
        ++poses;
      }
    }
  }
  EXPECT_GT(poses, 60u);
}

const std::map<std::string, std::size_t> kOfMan{
    {"trousers", 3},  {"shirt", 4},     {"head-and-neck", 1}, {"left-ear", 0},  {"right-ear", 0}, {"left-arm", 1},
    {"right-arm", 1}, {"left-shoe", 0}, {"right-shoe", 0},    {"left-sole", 0}, {"right-sole", 0}};
const std::map<std::string, std::size_t> kOfDog{
    {"body", 4}, {"left-hind-sock", 2}, {"right-hind-sock", 2}, {"left-fore-sock", 2}, {"right-fore-sock", 2}};

std::map<std::string, std::size_t> of_horse() {
  auto hems = kOfDog;
  hems["mane"] = 0;
  return hems;
}

INSTANTIATE_TEST_SUITE_P(Examples, FiguresBend,
                         testing::Values(std::tuple{"human.json", kOfMan}, std::tuple{"child.json", kOfMan},
                                         std::tuple{"stout.json", kOfMan}, std::tuple{"dog.json", kOfDog},
                                         std::tuple{"horse.json", of_horse()}));

}  // namespace
}  // namespace mars::modeler
