#include "tests/bench/peers/embree_view.h"

#include <algorithm>
#include <bit>

#include "tests/bench/peers/light.h"

namespace mars::bench {
namespace {

// Of triangles [first, last).
RTCScene build(RTCDevice device, const Mesh& mesh, std::uint32_t first, std::uint32_t last) {
  RTCScene scene = rtcNewScene(device);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
  void* places = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                         mesh.vertices.size());
  for (std::size_t k = 0; k < mesh.vertices.size(); ++k)
    std::copy_n(mesh.vertices[k].place.data(), 3, static_cast<float*>(places) + 3 * k);
  void* corners =
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(Corners), last - first);
  std::copy_n(&mesh.triangles[first], last - first, static_cast<Corners*>(corners));
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
  return scene;
}

std::vector<Normals> normals_of(const Mesh& mesh, std::uint32_t first, std::uint32_t last) {
  std::vector<Normals> normals(last - first);
  for (const MeshPatch& patch : mesh.patches) {
    if (patch.first_triangle < first || patch.first_triangle >= last) continue;
    for (std::uint32_t t = patch.first_triangle; t < patch.first_triangle + patch.triangles; ++t) {
      Normals& out = normals[t - first];
      out.look = patch.look;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto at = [&](std::size_t corner) { return mesh.vertices[mesh.triangles[t][corner]].normal[axis]; };
        out.first[axis] = at(0);
        out.to_second[axis] = at(1) - at(0);
        out.to_third[axis] = at(2) - at(0);
      }
    }
  }
  return normals;
}

// Phong's interpolation, a triangle after the other: most packets meet few, and gathering is slow.
void interpolate(const View& view, const Mesh& mesh, const Points& points, Ints met, Floats* normal, Floats* color) {
  for (unsigned left = mask_of(met); left != 0;) {
    const int triangle = points.triangles[std::countr_zero(left)];
    const Ints own = met & (points.triangles == triangle);
    left &= ~mask_of(own);
    const Normals& at = view.normals[static_cast<std::size_t>(triangle)];
    for (int axis = 0; axis < 3; ++axis)
      normal[axis] = own ? at.first[axis] + points.u * at.to_second[axis] + points.v * at.to_third[axis] : normal[axis];
    for (std::size_t c = 0; c < 3; ++c) color[c] = own ? Floats{} + mesh.looks[at.look][c] : color[c];
  }
}

}  // namespace

View view_of(const Mesh& mesh, bool moving, RTCDevice device) {
  const std::uint32_t border = mesh.first_moving_triangle();
  const std::uint32_t first = moving ? border : 0, last = moving ? mesh.head.triangles : border;
  View view{};
  if (first == last) return view;
  view.scene = build(device, mesh, first, last);
  view.normals = normals_of(mesh, first, last);
  view.outlines = outlines_of(mesh, moving);
  set_motion(view, mesh.head, kStill);
  return view;
}

void set_motion(View& view, const MeshHead& head, const Motion& motion) {
  const auto& [across, down, to_light] = light_axes(head, {}).axis;
  const std::array<float, 3> eye[6] = {{0, 0, -1}, {1, 0, 0}, {0, 1, 0}, to_light, across, down};
  float* turned[6] = {view.ahead, view.right, view.up, view.to_light, view.across_light[0], view.across_light[1]};
  for (std::size_t c = 0; c < 3; ++c) {
    for (int k = 0; k < 6; ++k)
      turned[k][c] = motion[0][c] * eye[k][0] + motion[1][c] * eye[k][1] + motion[2][c] * eye[k][2];
    view.origin[c] = -(motion[0][c] * motion[0][3] + motion[1][c] * motion[1][3] + motion[2][c] * motion[2][3]);
  }
}

Directions directions_of(const View& view, Floats x, Floats y) {
  Directions directions;
  for (int axis = 0; axis < 3; ++axis)
    directions.axis[axis] = view.ahead[axis] + x * view.right[axis] + y * view.up[axis];
  return directions;
}

// Back faces are seldom seen: their few rays go on behind them, which costs less than a filter for all.
Ints trace(const View& view, const Directions& directions, Ints inside, Floats limit, RTCRayHit16& rays) {
  const Floats* direction = directions.axis;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  put(rays.ray.org_x, Floats{} + view.origin[0]);
  put(rays.ray.org_y, Floats{} + view.origin[1]);
  put(rays.ray.org_z, Floats{} + view.origin[2]);
  put(rays.ray.dir_x, direction[0]);
  put(rays.ray.dir_y, direction[1]);
  put(rays.ray.dir_z, direction[2]);
  put(rays.ray.tnear, Floats{});
  put(rays.ray.tfar, limit);
  put(rays.ray.time, Floats{});
  put(rays.ray.mask, Ints{} - 1);
  put(rays.hit.geomID, Ints{} - 1);
  Ints met = inside;
  for (Ints tracing = inside; any(tracing);) {
    rtcIntersect16(reinterpret_cast<const int*>(&tracing), view.scene, &context, &rays);
    met = inside & (got<Ints>(rays.hit.geomID) == 0);
    const Floats facing = got<Floats>(rays.hit.Ng_x) * direction[0] + got<Floats>(rays.hit.Ng_y) * direction[1] +
                          got<Floats>(rays.hit.Ng_z) * direction[2];
    tracing = met & (facing > 0);
    if (!any(tracing)) break;
    const Floats far = got<Floats>(rays.ray.tfar);
    put(rays.ray.tnear, tracing ? far * 1.000001f : got<Floats>(rays.ray.tnear));
    put(rays.ray.tfar, tracing ? limit : far);
    put(rays.hit.geomID, tracing ? Ints{} - 1 : got<Ints>(rays.hit.geomID));
  }
  return met;
}

Lit shade(const View& view, const Mesh& mesh, const Points& points, Ints met) {
  Floats normal[3] = {}, color[3] = {};
  interpolate(view, mesh, points, met, normal, color);
  const MeshHead& head = mesh.head;
  const Floats* direction = points.directions.axis;
  const auto dot = [](const auto& a, const auto& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
  const Floats shrink = inverse_root(dot(normal, normal)), toward = -inverse_root(dot(direction, direction));
  const Floats nl = dot(normal, view.to_light) * shrink;
  const Floats nv = dot(normal, direction) * shrink * toward;
  const Floats facing = nl > 0 ? nl : Floats{};
  const Floats rv = 2 * nl * nv - dot(direction, view.to_light) * toward;
  Floats shine = (nl > 0) & (rv > 0) ? rv : Floats{};
  for (std::uint32_t s = 0; s < head.squarings; ++s) shine *= shine;
  Lit lit;
  for (std::size_t c = 0; c < 3; ++c) {
    lit.base.level[c] = color[c] * head.ambient;
    lit.term.level[c] = (color[c] * head.diffuse * facing + head.specular * shine) * head.light[c];
  }
  return lit;
}

Levels levels_of(const Lit& lit, Floats share) {
  Levels levels;
  for (int c = 0; c < 3; ++c) {
    const Floats level = lit.base.level[c] + share * lit.term.level[c];
    levels.level[c] = level < 1 ? level : Floats{} + 1;
  }
  return levels;
}

Ints facing_light(const View& view, const RTCRayHit16& rays) {
  return got<Floats>(rays.hit.Ng_x) * view.to_light[0] + got<Floats>(rays.hit.Ng_y) * view.to_light[1] +
             got<Floats>(rays.hit.Ng_z) * view.to_light[2] >
         0;
}

}  // namespace mars::bench
