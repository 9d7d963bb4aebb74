#include "tests/bench/peers/cover.h"

#include <algorithm>
#include <limits>

namespace mars::bench {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();

Outline corners_of_box(const Outline& points) {
  std::array<float, 3> low = points[0], high = points[0];
  for (const auto& point : points)
    for (std::size_t c = 0; c < 3; ++c) low[c] = std::min(low[c], point[c]), high[c] = std::max(high[c], point[c]);
  Outline corners;
  for (int k = 0; k < 8; ++k)
    corners.push_back({(k & 1 ? high : low)[0], (k & 2 ? high : low)[1], (k & 4 ? high : low)[2]});
  return corners;
}

}  // namespace

std::vector<Outline> outlines_of(const Mesh& mesh, bool moving) {
  std::vector<Outline> outlines;
  for (const MeshPatch& patch : mesh.patches) {
    if ((patch.moves == 1) != moving) continue;
    Outline points;
    for (std::uint32_t k = patch.first_vertex; k < patch.first_vertex + patch.vertices; ++k)
      points.push_back(mesh.vertices[k].place);
    outlines.push_back(moving ? points : corners_of_box(points));
  }
  return outlines;
}

Area cover(const Outline& outline, const MeshHead& head, const Motion& m) {
  float low[2] = {kFar, kFar}, high[2] = {-kFar, -kFar};
  for (const auto& p : outline) {
    float q[3];
    for (std::size_t r = 0; r < 3; ++r) q[r] = m[r][0] * p[0] + m[r][1] * p[1] + m[r][2] * p[2] + m[r][3];
    if (q[2] > -head.near) return {0, 0, static_cast<int>(head.width), static_cast<int>(head.height)};
    const float x = head.center[0] - head.scale * q[0] / q[2], y = head.center[1] + head.scale * q[1] / q[2];
    low[0] = std::min(low[0], x), high[0] = std::max(high[0], x);
    low[1] = std::min(low[1], y), high[1] = std::max(high[1], y);
  }
  const auto clamped = [](float v, std::uint32_t most) {
    return static_cast<int>(std::clamp(v, 0.0f, static_cast<float>(most)));
  };
  return {clamped(low[0], head.width), clamped(low[1], head.height), clamped(high[0] + 1, head.width),
          clamped(high[1] + 1, head.height)};
}

}  // namespace mars::bench
