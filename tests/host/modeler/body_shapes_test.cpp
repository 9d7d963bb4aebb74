#include "host/modeler/body_shapes.h"

#include <gtest/gtest.h>

#include <numeric>

#include "host/modeler/loft.h"
#include "tests/host/modeler/surface.h"

namespace mars::host {
namespace {

constexpr BodyPart kParts[] = {BodyPart::head,    BodyPart::hair,      BodyPart::neck,       BodyPart::torso,
                               BodyPart::abdomen, BodyPart::pelvis,    BodyPart::upper_arm,  BodyPart::sleeve,
                               BodyPart::forearm, BodyPart::left_hand, BodyPart::right_hand, BodyPart::thigh,
                               BodyPart::shin,    BodyPart::foot,      BodyPart::toes};

TEST(BodyShapes, AreClosedBitForBit) {
  for (const BodyPart part : kParts)
    for (const auto& [edge, use] : edge_uses(make_body(part))) {
      EXPECT_EQ(use.forward, 1) << static_cast<int>(part);
      EXPECT_EQ(use.backward, 1) << static_cast<int>(part);
    }
}

TEST(BodyShapes, FillTheUnitCube) {
  for (const BodyPart part : kParts)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      float least = 1, greatest = 0;
      for (const node::Patch& patch : make_body(part))
        for (const auto& point : patch.points) {
          least = std::min(least, point[axis]);
          greatest = std::max(greatest, point[axis]);
        }
      EXPECT_EQ(least, 0.0f) << static_cast<int>(part);
      EXPECT_EQ(greatest, 1.0f) << static_cast<int>(part);
    }
}

// Patches that hang together by their corners: a hand is a palm and five fingers.
std::vector<std::vector<node::Patch>> pieces_of(const std::vector<node::Patch>& patches) {
  std::vector<std::size_t> group(patches.size());
  std::iota(group.begin(), group.end(), 0);
  const auto root = [&](std::size_t i) {
    while (group[i] != i) i = group[i];
    return i;
  };
  std::map<Point, std::size_t> owner;
  for (std::size_t i = 0; i < patches.size(); ++i)
    for (const std::size_t corner : {0, 3, 12, 15})
      group[root(i)] = root(owner.try_emplace(patches[i].points[corner], i).first->second);
  std::map<std::size_t, std::vector<node::Patch>> pieces;
  for (std::size_t i = 0; i < patches.size(); ++i) pieces[root(i)].push_back(patches[i]);
  std::vector<std::vector<node::Patch>> result;
  for (auto& [first, piece] : pieces) result.push_back(std::move(piece));
  return result;
}

TEST(BodyShapes, HaveTheirOutsideOut) {
  for (const BodyPart part : kParts) {
    const auto pieces = pieces_of(make_body(part));
    const bool is_hand = part == BodyPart::left_hand || part == BodyPart::right_hand;
    EXPECT_EQ(pieces.size(), is_hand ? 6u : part == BodyPart::head ? 3u : 1u) << static_cast<int>(part);
    for (const auto& piece : pieces) EXPECT_GT(volume_of(piece, 6), 0.0005) << static_cast<int>(part);
  }
}

// The unit normals on both patches of every shared side, at three places of it.
TEST(BodyShapes, AreSmoothAcrossTheirEdges) {
  constexpr double ends[4][4] = {
      {0, 0, 1, 0}, {1, 0, 1, 1}, {1, 1, 0, 1}, {0, 1, 0, 0}};  // u, v as sides_of runs
  for (const BodyPart part : kParts) {
    std::map<std::pair<Edge, int>, glm::dvec3> seen;
    for (const node::Patch& patch : make_body(part)) {
      const auto sides = sides_of(patch);
      for (std::size_t side = 0; side < 4; ++side)
        for (const int step : {1, 2, 3}) {
          if (collapsed(sides[side])) continue;
          const Edge back{sides[side][3], sides[side][2], sides[side][1], sides[side][0]};
          const double t = step / 4.0, u = ends[side][0] + t * (ends[side][2] - ends[side][0]),
                       v = ends[side][1] + t * (ends[side][3] - ends[side][1]);
          const glm::dvec3 normal = glm::normalize(normal_of(patch, u, v));
          const auto other = seen.find({back, 4 - step});
          if (other == seen.end()) {
            seen[{sides[side], step}] = normal;
          } else {
            EXPECT_GT(glm::dot(normal, other->second), 0.9995) << static_cast<int>(part);
          }
        }
    }
  }
}

TEST(BodyShapes, HandsMirrorEachOther) {
  const auto left = make_body(BodyPart::left_hand), right = make_body(BodyPart::right_hand);
  for (std::size_t patch = 0; patch < left.size(); ++patch)
    for (const auto& [u, v] : {std::pair{0.2, 0.7}, {0.9, 0.1}}) {
      const glm::dvec3 l = point_of(left[patch], u, v), r = point_of(right[patch], 1 - u, v);
      EXPECT_LT(glm::length(l - glm::dvec3(r.x, 1 - r.y, r.z)), 1e-6);
    }
}

TEST(Loft, OfEqualRingsIsACylinder) {
  constexpr Ring rings[] = {{0, 1, 1, 1}, {1, 1, 1, 1}, {2, 1, 1, 1},
                            {3, 1, 1, 1}, {4, 1, 1, 1}, {5, 1, 1, 1}};
  Net net;
  add_loft(net, {.rings = rings});
  for (const auto& patch : net)
    for (const std::size_t corner : {0, 3}) {
      const glm::dvec3& p = patch[corner];
      if (p.z > 1.5 && p.z < 3.5) {
        EXPECT_NEAR(std::hypot(p.x, p.y), 1, 1e-12);
      }
    }
}

TEST(Loft, ReachesItsPolesFlat) {
  constexpr Ring rings[] = {{0, 1, 1, 1}, {1, 1, 1, 1}, {2, 1, 1, 1}};
  Net net;
  add_loft(net, {.rings = rings});
  double least = 1, greatest = 0;
  for (const auto& patch : net)
    for (const auto& point : patch) least = std::min(least, point.z), greatest = std::max(greatest, point.z);
  EXPECT_EQ(least, 0);
  EXPECT_EQ(greatest, 2);
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(net[0][i].z, 0);  // the pole and the handles beside it
}

}  // namespace
}  // namespace mars::host
