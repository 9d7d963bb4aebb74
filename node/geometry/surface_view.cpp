#include "node/geometry/surface_view.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mars::geometry {
namespace {

// From b's result to a's.
wire::Matrix product(const wire::Matrix& a, const wire::Matrix& b) {
  wire::Matrix out;
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 4; ++c)
      out.m[r][c] = a.m[r][0] * b.m[0][c] + a.m[r][1] * b.m[1][c] + a.m[r][2] * b.m[2][c] + (c == 3 ? a.m[r][3] : 0);
  return out;
}

// False where the map has no inverse.
bool invert(const wire::Matrix& of, wire::Matrix& inverse) {
  const auto& m = of.m;
  const auto cofactor = [&](std::size_t r, std::size_t c) {
    const std::size_t r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
    return m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1];
  };
  const double determinant = m[0][0] * cofactor(0, 0) + m[0][1] * cofactor(0, 1) + m[0][2] * cofactor(0, 2);
  if (!std::isnormal(determinant)) return false;
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) inverse.m[r][c] = cofactor(c, r) / determinant;
    inverse.m[r][3] = -(inverse.m[r][0] * m[0][3] + inverse.m[r][1] * m[1][3] + inverse.m[r][2] * m[2][3]);
  }
  return true;
}

void normalize(float* vector) {
  const float length = std::sqrt((vector[0] * vector[0] + vector[1] * vector[1]) + vector[2] * vector[2]);
  for (int axis = 0; axis < 3; ++axis) vector[axis] = length > 0 ? vector[axis] / length : 0;
}

// Whether the track has the same value at the frame and the one before.
bool stays(const wire::PackedFilm& film, const wire::Track& track, std::uint32_t frame) {
  return film.value_at(track, frame) == film.value_at(track, frame - 1);
}

bool stays(const wire::PackedFilm& film, const wire::Segment& segment, std::uint32_t frame) {
  if (segment.bone_count == 0) return stays(film, segment.motion, frame);
  return std::ranges::all_of(film.bones_of(segment), [&](const wire::Track& bone) { return stays(film, bone, frame); });
}

using Float3 = std::array<float, 3>;

constexpr std::uint8_t kNet = 9;  // places along each side of a patch whose motion is sought

std::array<float, 4> bernstein(float t) {
  const float s = 1 - t;
  return {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
}

// Bones of a segment at a frame, seen by its camera.
void put_bones(const wire::PackedFilm& film, const wire::Segment& segment, std::uint32_t frame, EyeBones& bones) {
  bones.begin(segment.blend, segment.bone_count);
  for (std::uint32_t bone = 0; bone < segment.bone_count; ++bone)
    bones.put(bone, shape::eye_matrix(film.camera_at(frame).world_to_eye,
                                      film.matrix_at(film.bones_of(segment)[bone], frame)));
}

// Where points with a skin are, as `bones` move them.
void put_moved(const wire::PackedFilm& film, const wire::Skin& skin, std::span<const Float3> points,
               const EyeBones& bones, std::vector<Float3>& out) {
  const auto count = static_cast<std::uint32_t>(points.size());
  out.resize(count);
  for (std::uint32_t point = 0; point < count; ++point) {
    float place[3];
    shape::to_eye(blended(film, skin, point, count, bones), points[point], place);
    std::copy_n(place, 3, out[point].begin());
  }
}

// Instead of a patch's control points, places on it: kNet x kNet, u first.
void put_net(std::vector<Float3>& points) {
  std::array<Float3, wire::kPatchPoints> control;
  std::copy_n(points.begin(), control.size(), control.begin());
  points.assign(kNet * kNet, {});
  for (std::size_t place = 0; place < points.size(); ++place) {
    const auto along_u = bernstein(static_cast<float>(place % kNet) / (kNet - 1));
    const auto along_v = bernstein(static_cast<float>(place / kNet) / (kNet - 1));
    for (std::size_t point = 0; point < control.size(); ++point)
      for (std::size_t axis = 0; axis < 3; ++axis)
        points[place][axis] += along_v[point / 4] * along_u[point % 4] * control[point][axis];
  }
}

std::vector<wire::MeshTriangle> triangles_of_net() {
  std::vector<wire::MeshTriangle> triangles;
  for (std::uint8_t row = 0; row + 1 < kNet; ++row)
    for (std::uint8_t column = 0; column + 1 < kNet; ++column) {
      const auto at = static_cast<std::uint8_t>(row * kNet + column), above = static_cast<std::uint8_t>(at + kNet);
      const auto next = static_cast<std::uint8_t>(at + 1), last = static_cast<std::uint8_t>(above + 1);
      triangles.push_back({at, next, last});
      triangles.push_back({at, last, above});
    }
  return triangles;
}

Float3 difference(const Float3& a, const Float3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
float dot(const Float3& a, const Float3& b) { return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]; }

// a + u (b - a) + v (c - a)
Float3 between(const Float3& a, const Float3& b, const Float3& c, float u, float v) {
  const Float3 along = difference(b, a), across = difference(c, a);
  Float3 place;
  for (std::size_t axis = 0; axis < 3; ++axis) place[axis] = a[axis] + (u * along[axis] + v * across[axis]);
  return place;
}

// Parts of a triangle's sides, from its first corner, that lead to a point of it near `place`.
std::array<float, 2> parts_near(const Float3& place, const Float3& a, const Float3& b, const Float3& c) {
  const Float3 along = difference(b, a), across = difference(c, a), way = difference(place, a);
  const float aa = dot(along, along), ab = dot(along, across), bb = dot(across, across);
  const float determinant = aa * bb - ab * ab;
  if (!(determinant > 0)) return {0, 0};
  const float u = std::max(0.0f, (bb * dot(along, way) - ab * dot(across, way)) / determinant);
  const float v = std::max(0.0f, (aa * dot(across, way) - ab * dot(along, way)) / determinant);
  const float sum = std::max(1.0f, u + v);
  return {u / sum, v / sum};
}

}  // namespace

void SurfaceView::set_frame(std::uint32_t frame, bool motion) {
  const auto& to_eye = scene_.camera().world_to_eye.m;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t row = 0; row < 3; ++row) to_world_[axis][row] = static_cast<float>(to_eye[row][axis]);
  frame_ = frame;
  bent_.patch.reset();
  bent_.segment.reset();
  ways_.clear();
  still_has_moved_ = false;
  if (motion && frame > 0) find_ways(frame);
}

void SurfaceView::find_ways(std::uint32_t frame) {
  const wire::PackedFilm& film = scene_.film();
  const wire::Camera& now = film.camera_at(frame);
  const wire::Camera& then = film.camera_at(frame - 1);
  before_ = projection_of(then, film.settings());
  wire::Matrix to_world;
  if (!invert(now.world_to_eye, to_world)) return;
  ways_.resize(film.segments().size());
  for (std::size_t number = 0; number < ways_.size(); ++number) {
    const wire::Segment& segment = film.segments()[number];
    wire::Matrix from_world;
    if (stays(film, segment, frame) && now == then) continue;
    if (segment.bone_count > 0) {
      ways_[number].moves = ways_[number].has_skin = true;
      still_has_moved_ |= scene_.stands(number) && (!(now == then) || standing_bone_moved(number));
      continue;
    }
    if (!invert(film.matrix_at(segment, frame), from_world)) continue;
    const wire::Matrix way =
        product(then.world_to_eye, product(film.matrix_at(segment, frame - 1), product(from_world, to_world)));
    ways_[number].moves = true;
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 4; ++c) ways_[number].m[r][c] = static_cast<float>(way.m[r][c]);
    still_has_moved_ |= !scene_.moves(number);
  }
}

bool SurfaceView::standing_bone_moved(std::size_t segment) const {
  const auto bones = scene_.film().bones_of(scene_.film().segments()[segment]);
  for (std::uint32_t bone = 0; bone < bones.size(); ++bone)
    if (!scene_.bone_moves(segment, bone) && !stays(scene_.film(), bones[bone], frame_)) return true;
  return false;
}

wire::SurfacePoint SurfaceView::at(const Triangle& triangle, std::int32_t x, std::int32_t y) const {
  const Place place = place_of(triangle, x, y);
  wire::SurfacePoint point{-place.eye[2], {}, {}, scene_.segment_of(triangle.patch)};
  put_normal(triangle, place, point.normal);
  put_motion(triangle, place, point.segment, point.motion);
  return point;
}

// As kernels shade it (shading/kernels/fragments.h).
SurfaceView::Place SurfaceView::place_of(const Triangle& t, std::int32_t x, std::int32_t y) const {
  const shape::Projection& p = scene_.projection();
  constexpr float kPixel = 1.0f / shape::kSubpixels;
  Place place{{}, {}, {}};
  place.pixel[0] = static_cast<float>(x + p.origin[0] * shape::kSubpixels) * kPixel;
  place.pixel[1] = static_cast<float>(y + p.origin[1] * shape::kSubpixels) * kPixel;
  const auto dx = static_cast<float>(x - t.first_x), dy = static_cast<float>(y - t.first_y);
  for (int k = 0; k < shape::kValues; ++k) place.values[k] = (t.at_first[k] + dy * t.per_y[k]) + dx * t.per_x[k];
  const float w = p.parallel ? -place.values[shape::kDepth] : 1 / place.values[shape::kDepth];
  const float at_plane = p.parallel ? 1 : w;
  place.eye[0] = (place.pixel[0] - p.center[0]) / (p.scale * p.squeeze) * at_plane;
  place.eye[1] = (p.center[1] - place.pixel[1]) / p.scale * at_plane;
  place.eye[2] = -w;
  return place;
}

// Where triangles carry colours, of the triangle's plane (shading/kernels/unsummed.cpp), else of the surface.
void SurfaceView::put_normal(const Triangle& t, const Place& place, float* normal) const {
  const shape::Projection& p = scene_.projection();
  float in_eye[3] = {place.values[shape::kNormalX], place.values[shape::kNormalY], place.values[shape::kNormalZ]};
  if (scene_.film().materials()[t.material].interpolation != wire::Interpolation::phong) {
    const float across = p.scale * p.squeeze * shape::kSubpixels, up = p.scale * shape::kSubpixels;
    const float per_x = t.per_x[shape::kDepth], per_y = t.per_y[shape::kDepth];
    const float dy = p.center[1] * shape::kSubpixels - static_cast<float>(t.first_y + p.origin[1] * shape::kSubpixels);
    const float dx = p.center[0] * shape::kSubpixels - static_cast<float>(t.first_x + p.origin[0] * shape::kSubpixels);
    in_eye[0] = -(per_x * across);
    in_eye[1] = per_y * up;
    in_eye[2] = p.parallel ? 1.0f : (t.at_first[shape::kDepth] + dy * per_y) + dx * per_x;
  }
  normalize(in_eye);
  for (int axis = 0; axis < 3; ++axis)
    normal[axis] = (to_world_[axis][0] * in_eye[0] + to_world_[axis][1] * in_eye[1]) + to_world_[axis][2] * in_eye[2];
}

void SurfaceView::find_bent(std::uint32_t patch, std::uint32_t segment) const {
  if (bent_.patch == patch) return;
  bent_.patch = patch;
  const wire::PackedFilm& film = scene_.film();
  const wire::Segment& of = film.segments()[segment];
  const std::size_t number = patch - scene_.first_patch(segment), patches = film.shape(of.shape).patch_count;
  find_bones(segment);
  const bool same_camera = film.camera_at(frame_) == film.camera_at(frame_ - 1);
  bent_.stays = same_camera && std::ranges::all_of(film.bones_of_piece(of.shape, number),
                                                   [&](std::uint32_t bone) { return bent_.bone_stays[bone] == 1; });
  if (bent_.stays) return;
  if (number < patches) {
    static const std::vector<wire::MeshTriangle> kTriangles = triangles_of_net();
    put_patch(of, number, bent_.bones_now, bent_.now);
    put_patch(of, number, bent_.bones_before, bent_.before);
    bent_.triangles = kTriangles;
    return;
  }
  const wire::Meshlet& meshlet = film.meshlets_of(of.shape)[number - patches];
  const auto places = film.mesh_places().subspan(meshlet.first_vertex, meshlet.vertex_count);
  put_moved(film, meshlet.skin, places, bent_.bones_now, bent_.now);
  put_moved(film, meshlet.skin, places, bent_.bones_before, bent_.before);
  bent_.triangles = film.mesh_triangles().subspan(meshlet.first_triangle, meshlet.triangle_count);
}

void SurfaceView::find_bones(std::uint32_t segment) const {
  if (bent_.segment == segment) return;
  bent_.segment = segment;
  const wire::PackedFilm& film = scene_.film();
  const wire::Segment& of = film.segments()[segment];
  put_bones(film, of, frame_, bent_.bones_now);
  put_bones(film, of, frame_ - 1, bent_.bones_before);
  bent_.bone_stays.clear();
  for (const wire::Track& bone : film.bones_of(of)) bent_.bone_stays.push_back(stays(film, bone, frame_));
}

// Places on a patch of the segment's shape, see put_net().
void SurfaceView::put_patch(const wire::Segment& segment, std::size_t number, const EyeBones& bones,
                            std::vector<Float3>& out) const {
  const wire::PackedFilm& film = scene_.film();
  bent_.net.start(film);
  const auto move = [&](const wire::NetPoint& point) { return moved_point(film, point, bones); };
  out.resize(wire::kPatchPoints);
  const wire::PatchStencils& stencils = film.net_patches_of(segment.shape)[number].stencils;
  for (std::size_t point = 0; point < out.size(); ++point) out[point] = bent_.net.bezier(film, stencils[point], move);
  put_net(out);
}

// Where the point was: on the triangle that is nearest to it now, of what is bent_.
void SurfaceView::put_before(const Place& place, float* eye) const {
  const Float3 point{place.eye[0], place.eye[1], place.eye[2]};
  float least = std::numeric_limits<float>::max();
  Float3 before{};
  for (const wire::MeshTriangle& t : bent_.triangles) {
    const auto [u, v] = parts_near(point, bent_.now[t[0]], bent_.now[t[1]], bent_.now[t[2]]);
    const Float3 away = difference(between(bent_.now[t[0]], bent_.now[t[1]], bent_.now[t[2]], u, v), point);
    if (const float square = dot(away, away); square < least) {
      least = square;
      before = between(bent_.before[t[0]], bent_.before[t[1]], bent_.before[t[2]], u, v);
    }
  }
  std::ranges::copy(before, eye);
}

// 0 where the point was not before the eye.
void SurfaceView::put_motion(const Triangle& triangle, const Place& place, std::uint32_t segment, float* motion) const {
  if (ways_.empty() || !ways_[segment].moves) return;
  const auto& m = ways_[segment].m;
  float eye[3];
  if (ways_[segment].has_skin) {
    find_bent(triangle.patch, segment);
    if (bent_.stays) return;
    put_before(place, eye);
  }
  for (int axis = 0; axis < 3 && !ways_[segment].has_skin; ++axis)
    eye[axis] = ((m[axis][0] * place.eye[0] + m[axis][1] * place.eye[1]) + m[axis][2] * place.eye[2]) + m[axis][3];
  const float w = -eye[2];
  if (!before_.parallel && !(w > 0)) return;
  const float scale = before_.parallel ? before_.scale : before_.scale / w;
  motion[0] = (before_.center[0] + scale * before_.squeeze * eye[0]) - place.pixel[0];
  motion[1] = place.pixel[1] - (before_.center[1] - scale * eye[1]);
}

}  // namespace mars::geometry
