#include "host/content/modeler/body_shapes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "host/content/modeler/loft.h"
#include "tests/host/content/modeler/surface.h"

namespace mars::modeler {
namespace {

TEST(BodyShapes, HandsMirrorEachOther) {
  const auto left = make_body(BodyPart::left_hand), right = make_body(BodyPart::right_hand);
  for (std::size_t patch = 0; patch < left.size(); ++patch)
    for (const auto& [u, v] : {std::pair{0.2, 0.7}, {0.9, 0.1}}) {
      const glm::dvec3 l = point_of(left[patch], u, v), r = point_of(right[patch], 1 - u, v);
      EXPECT_LT(glm::length(l - glm::dvec3(r.x, 1 - r.y, r.z)), 1e-6);
    }
}

TEST(Loft, OfEqualRingsIsACylinder) {
  constexpr Ring rings[] = {{0, 1, 1, 1}, {1, 1, 1, 1}, {2, 1, 1, 1}, {3, 1, 1, 1}, {4, 1, 1, 1}, {5, 1, 1, 1}};
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
}  // namespace mars::modeler
