#include "host/content/modeler/frames.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "host/content/modeler/read_model.h"

namespace mars::modeler {
namespace {

Model framed_model(const std::string& json) {
  const document::Document document(json, "m.json");
  return read_model(document.root());
}

void expect_close(const glm::dvec3& is, const glm::dvec3& wanted, double error = 1e-12) {
  EXPECT_LT(glm::length(is - wanted), error) << is.x << " " << is.y << " " << is.z;
}

glm::dvec3 placed(const wire::Matrix& matrix, const glm::dvec3& point) {
  glm::dvec3 result;
  for (int row = 0; row < 3; ++row)
    result[row] =
        matrix.m[row][0] * point.x + matrix.m[row][1] * point.y + matrix.m[row][2] * point.z + matrix.m[row][3];
  return result;
}

// Figure 2.5: y leans 30 degrees from upright towards x, so the box becomes a parallelepiped of base 2 and
// height 3 cos 30, its top moved by 3 sin 30; z = x cross y is as much shorter as the two axes are nearer.
TEST(Frames, SkewedAxesShearTheSegment) {
  const Model model = framed_model(R"({"joints": [{"name": "a", "y_axis": [0.5, 0.8660254037844386, 0],
      "limits": {}, "segment": {"shape": "box", "sbb": [[0, 0, 0], [2, 3, 1]]}}]})");
  const Joint& joint = model.joints[0];
  const wire::Matrix matrix = t_matrix(segment_frame(rest_frames(model)[0], joint), joint.segment->sbb);
  const double cosine = std::sqrt(0.75);
  expect_close(placed(matrix, {0, 0, 0}), {0, 0, 0});
  expect_close(placed(matrix, {1, 0, 0}), {2, 0, 0});
  expect_close(placed(matrix, {0, 1, 0}), {1.5, 3 * cosine, 0});
  expect_close(placed(matrix, {1, 1, 0}), {3.5, 3 * cosine, 0});
  expect_close(placed(matrix, {0, 0, 1}), {0, 0, cosine});
  const auto bounds = rest_bounds(model);
  expect_close(bounds->max, {3.5, 3 * cosine, cosine}, 1e-6);
}

TEST(Frames, ChildrenOfSkewedJointsAreNotSheared) {
  const Model model = framed_model(R"({"joints": [{"name": "a", "y_axis": [1, 1, 0], "limits": {}},
      {"name": "b", "parent": "a", "place": [1, 2, 3], "limits": {},
       "segment": {"shape": "box", "sbb": [[0, 0, 0], [1, 1, 1]]}}]})");
  const auto bounds = rest_bounds(model);
  expect_close(bounds->min, {1, 2, 3}, 1e-6);
  expect_close(bounds->max, {2, 3, 4}, 1e-6);
}

// Held at 90 degrees about y, x looks down and z along x.
TEST(Frames, RestIsThePoseThatLimitsHold) {
  const Model model = framed_model(R"({"joints": [{"name": "a", "place": [0, 0, 5], "limits": {"y": [90, 120]}},
      {"name": "b", "parent": "a", "place": [2, 0, 0], "limits": {},
       "segment": {"shape": "box", "sbb": [[0, 0, 0], [1, 1, 4]]}}]})");
  const std::vector<Axes> frames = rest_frames(model);
  expect_close(frames[1].place, {0, 0, 3});
  const auto bounds = rest_bounds(model);
  expect_close(bounds->min, {0, 0, 2}, 1e-6);
  expect_close(bounds->max, {4, 1, 3}, 1e-6);
}

// A ball turned askew is still as high as its diameter, whatever its control points do.
TEST(Frames, BoundsAreThoseOfTheSurface) {
  const Model model = framed_model(R"({"joints": [{"name": "a", "x_axis": [0.8, 0, 0.6], "limits": {},
      "segment": {"shape": "sphere", "sbb": [[-1, -1, -1], [1, 1, 1]]}}]})");
  const auto bounds = rest_bounds(model);
  EXPECT_NEAR(bounds->max.z, 1, 2e-3);
  EXPECT_NEAR(bounds->min.x, -1, 2e-3);
  EXPECT_FALSE(rest_bounds(framed_model(R"({"joints": [{"name": "a"}]})")));
}

}  // namespace
}  // namespace mars::modeler
