#include "node/geometry/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace mars::geometry {
namespace {

// Screen places stay below 2^24 / 256, exact in a float, however the picture is shifted.
constexpr float kGuardPixels = 32768;
static_assert(kGuardPixels + wire::kMaxSide * (0.5 + wire::kMostShift) < (1 << 24) / 256);
// All that is drawn lies within the guard band.
static_assert(wire::kMaxSide * (0.5 + wire::kMostShift) + wire::kMostMargin <= kGuardPixels);

EyeLight to_eye(const wire::Light& light, const wire::Matrix& world_to_eye) {
  EyeLight out = light;
  const bool has_place = light.kind != wire::LightKind::directional;
  for (std::size_t r = 0; r < 3; ++r) {
    const auto& row = world_to_eye.m[r];
    const double offset = has_place ? row[3] : 0.0;
    out.vector[r] =
        static_cast<float>(row[0] * light.vector[0] + row[1] * light.vector[1] + row[2] * light.vector[2] + offset);
    out.axis[r] = static_cast<float>(row[0] * light.axis[0] + row[1] * light.axis[1] + row[2] * light.axis[2]);
  }
  return out;
}

constexpr float kUnreached = std::numeric_limits<float>::max();
constexpr ShapeBoxes::Box kEmptyBox{{kUnreached, kUnreached, kUnreached}, {-kUnreached, -kUnreached, -kUnreached}};

void take_in(const std::array<float, 3>& low, const std::array<float, 3>& high, ShapeBoxes::Box& box) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.low[axis] = std::min(box.low[axis], low[axis]);
    box.high[axis] = std::max(box.high[axis], high[axis]);
  }
}

ShapeBoxes::Box box_of(const wire::PackedFilm& film, std::uint32_t shape) {
  ShapeBoxes::Box box = kEmptyBox;
  for (const wire::Patch& patch : film.patches_of(shape))
    for (const auto& point : patch.points) take_in(point, point, box);
  for (const wire::Meshlet& meshlet : film.meshlets_of(shape)) take_in(meshlet.low, meshlet.high, box);
  return box;
}

// Visits the points of nets and meshlets of a shape with a skin, part by part.
template <typename Visit>
void visit_skins(const wire::PackedFilm& film, std::uint32_t shape, const Visit& visit) {
  std::vector<bool> visited(film.net_patches_of(shape).empty() ? 0 : film.net_points().size());
  for (const wire::NetPatch& patch : film.net_patches_of(shape))
    for (const std::uint32_t stencil : patch.stencils)
      for (const wire::StencilTerm& term : film.terms_of(film.stencils()[stencil])) {
        if (visited[term.point]) continue;
        visited[term.point] = true;
        const wire::NetPoint& point = film.net_points()[term.point];
        visit(point.skin, std::span(&point.place, 1));
      }
  for (const wire::Meshlet& m : film.meshlets_of(shape))
    visit(m.skin, film.mesh_places().subspan(m.first_vertex, m.vertex_count));
}

// `boxes` are of the bones of the skin's segment.
void take_in_points(const wire::PackedFilm& film, const wire::Skin& skin, std::span<const std::array<float, 3>> points,
                    std::span<ShapeBoxes::Box> boxes) {
  auto weights = film.weights_of(skin, static_cast<std::uint32_t>(points.size()));
  for (const std::uint32_t bone : film.bones_of(skin)) {
    for (std::size_t point = 0; point < points.size(); ++point)
      if (weights[point] > 0) take_in(points[point], points[point], boxes[bone]);
    weights = weights.subspan(points.size());
  }
}

using PairBoxes = std::map<std::array<std::uint32_t, 2>, ShapeBoxes::Box>;

void take_in_pairs(const wire::PackedFilm& film, const wire::Skin& skin, std::span<const std::array<float, 3>> points,
                   PairBoxes& pairs) {
  const auto bones = film.bones_of(skin);
  const auto weights = film.weights_of(skin, static_cast<std::uint32_t>(points.size()));
  for (std::size_t a = 0; a < bones.size(); ++a)
    for (std::size_t b = a + 1; b < bones.size(); ++b) {
      ShapeBoxes::Box box = kEmptyBox;
      for (std::size_t point = 0; point < points.size(); ++point)
        if (weights[a * points.size() + point] > 0 && weights[b * points.size() + point] > 0)
          take_in(points[point], points[point], box);
      if (box.is_empty()) continue;
      take_in(std::to_array(box.low), std::to_array(box.high),
              pairs.try_emplace({bones[a], bones[b]}, kEmptyBox).first->second);
    }
}

BonePairs found_pairs(const wire::PackedFilm& film, const wire::Meshlet& meshlet) {
  BonePairs pairs{};
  const auto weights = film.weights_of(meshlet.skin, meshlet.vertex_count);
  for (std::uint32_t vertex = 0; vertex < meshlet.vertex_count; ++vertex) {
    std::uint16_t followed = 0;
    for (std::uint32_t bone = meshlet.skin.bone_count; bone-- > 0;) {
      if (!(weights[bone * meshlet.vertex_count + vertex] > 0)) continue;
      pairs[bone] |= followed;
      followed |= static_cast<std::uint16_t>(1u << bone);
    }
  }
  return pairs;
}

}  // namespace

shape::Projection projection_of(const wire::Camera& camera, const wire::FilmSettings& settings) {
  const auto width = static_cast<std::int32_t>(settings.whole_width());
  const auto height = static_cast<std::int32_t>(settings.whole_height());
  const bool parallel = camera.projection == wire::Projection::orthographic;
  const auto scale = static_cast<float>(camera.focal * height / 2);
  const auto center_x = static_cast<float>((0.5 - camera.shift_x) * width);
  const auto center_y = static_cast<float>((0.5 + camera.shift_y) * height);
  // From the view axis to the whole picture's farthest corner, in heights of pixels.
  const float x = std::max(center_x, static_cast<float>(width) - center_x) * settings.pixel_aspect;
  const float y = std::max(center_y, static_cast<float>(height) - center_y);
  return {.scale = scale,
          .center = {center_x, center_y},
          .near = static_cast<float>(camera.near),
          .far = static_cast<float>(camera.far),
          .guard = kGuardPixels,
          .corner = scale / std::sqrt(scale * scale + x * x + y * y),
          .radius = parallel ? std::sqrt(x * x + y * y) / scale : 0,
          .nothing = parallel ? shape::kFarthestDepth : 0,
          .parallel = parallel,
          .squeeze = 1 / settings.pixel_aspect,
          .origin = {settings.window.left, settings.window.top}};
}

const BonePairs* pairs_of(const wire::PackedFilm& film, const wire::Meshlet& meshlet, std::span<const BonePairs> all) {
  return all.empty() ? nullptr : &all[static_cast<std::size_t>(&meshlet - film.meshlets().data())];
}

ShapeBoxes::ShapeBoxes(const wire::PackedFilm& film) {
  boxes_.reserve(film.shape_count());
  std::vector<bool> is_dual(film.shape_count());
  for (const wire::Segment& segment : film.segments())
    if (segment.blend == wire::Blend::dual_quaternions) is_dual[segment.shape] = true;
  for (std::uint32_t shape = 0; shape < film.shape_count(); ++shape) {
    boxes_.push_back(box_of(film, shape));
    first_bone_.push_back(bones_.size());
    first_pair_.push_back(pairs_.size());
    add_bones(film, shape);
    if (is_dual[shape]) add_pairs(film, shape);
  }
  first_bone_.push_back(bones_.size());
  first_pair_.push_back(pairs_.size());
}

void ShapeBoxes::add_bones(const wire::PackedFilm& film, std::uint32_t shape) {
  const std::size_t first = bones_.size();
  bones_.resize(first + film.shape(shape).bone_count, kEmptyBox);
  visit_skins(film, shape, [&](const wire::Skin& skin, std::span<const std::array<float, 3>> points) {
    take_in_points(film, skin, points, std::span(bones_).subspan(first));
  });
}

void ShapeBoxes::add_pairs(const wire::PackedFilm& film, std::uint32_t shape) {
  PairBoxes boxes;
  visit_skins(film, shape, [&](const wire::Skin& skin, std::span<const std::array<float, 3>> points) {
    take_in_pairs(film, skin, points, boxes);
  });
  for (const auto& [bones, box] : boxes) pairs_.push_back({bones, box});
}

Scene::Scene(const wire::PackedFilm& film)
    : film_(film),
      tolerances_(shape::tolerances_of(film.settings().samples)),
      projection_(projection_of(film.camera_at(0), film.settings())) {
  first_patch_.reserve(film.segments().size());
  std::uint32_t next = 0;
  for (const wire::Segment& segment : film.segments()) {
    first_patch_.push_back(next);
    const auto size = static_cast<std::uint32_t>(film.shape(segment.shape).size());
    next += size;
    first_skin_piece_.push_back(segment.bone_count > 0 ? piece_moves_.size() : kRigid);
    if (segment.bone_count > 0) piece_moves_.resize(piece_moves_.size() + size);
    most_bones_ = std::max<std::size_t>(most_bones_, segment.bone_count);
  }
  const auto is_dual = [](const wire::Segment& s) { return s.blend == wire::Blend::dual_quaternions; };
  if (std::ranges::any_of(film.segments(), is_dual))
    for (const wire::Meshlet& meshlet : film.meshlets()) bone_pairs_.push_back(found_pairs(film, meshlet));
  moves_.resize(film.segments().size() + film.bones().size());
  moving_pieces_.resize(film.segments().size());
  moved_at_.resize(film.segments().size() + film.bones().size());
  lights_.resize(film.light_tracks().size());
  light_order_.resize(lights_.size());
  std::iota(light_order_.begin(), light_order_.end(), std::size_t{0});
  const auto casting = std::ranges::stable_partition(
      light_order_, [&](std::size_t track) { return !film.casts(film.light_tracks()[track]); });
  casting_count_ = static_cast<std::uint32_t>(casting.size());
}

void Scene::set_interval(std::uint32_t number) {
  const wire::Interval& interval = film_.intervals()[number];
  std::ranges::fill(moves_, std::uint8_t{0});
  std::ranges::fill(moving_pieces_, 0u);
  std::ranges::fill(piece_moves_, std::uint8_t{0});
  for (const std::uint32_t part : film_.moving(interval)) moves_[part] = 1;
  movers_ = film_.moving_segments(interval);
  for (const std::uint32_t segment : movers_) moving_pieces_[segment] = mark_moving_pieces(segment);
}

std::uint32_t Scene::mark_moving_pieces(std::size_t segment) {
  const wire::Segment& of = film_.segments()[segment];
  const auto size = static_cast<std::uint32_t>(film_.shape(of.shape).size());
  if (of.bone_count == 0) return size;
  std::uint32_t count = 0;
  for (std::uint32_t piece = 0; piece < size; ++piece) {
    const bool moves = std::ranges::any_of(film_.bones_of_piece(of.shape, piece),
                                           [&](std::uint32_t bone) { return bone_moves(segment, bone); });
    piece_moves_[first_skin_piece_[segment] + piece] = moves;
    count += moves;
  }
  return count;
}

bool Scene::stands(std::size_t segment) const {
  return moving_pieces_[segment] < film_.shape(film_.segments()[segment].shape).size();
}

bool Scene::any_stands() const {
  for (std::size_t segment = 0; segment < film_.segments().size(); ++segment)
    if (stands(segment)) return true;
  return false;
}

void Scene::set_frame(std::uint32_t frame) {
  frame_ = frame;
  const wire::Camera& camera = film_.camera_at(frame);
  projection_ = projection_of(camera, film_.settings());
  for (std::size_t i = 0; i < lights_.size(); ++i)
    lights_[i] =
        to_eye(film_.lights()[film_.value_at(film_.light_tracks()[light_order_[i]], frame)], camera.world_to_eye);
}

void Scene::move(std::span<const wire::MovedSegment> moved) {
  for (const wire::MovedSegment& before : moved_) moved_at_[before.segment] = 0;
  moved_.assign(moved.begin(), moved.end());
  for (std::uint32_t i = 0; i < moved_.size(); ++i) moved_at_[moved_[i].segment] = i + 1;
}

std::array<float, 3> Scene::up() const {
  const auto& to_eye = camera().world_to_eye.m;
  return {static_cast<float>(to_eye[0][2]), static_cast<float>(to_eye[1][2]), static_cast<float>(to_eye[2][2])};
}

std::uint32_t Scene::segment_of(std::uint32_t patch) const {
  return static_cast<std::uint32_t>(std::ranges::upper_bound(first_patch_, patch) - first_patch_.begin()) - 1;
}

shape::EyeMatrix Scene::matrix(std::size_t segment) const {
  const std::uint32_t moved = moved_at_[segment];
  const wire::Matrix& matrix =
      moved > 0 ? moved_[moved - 1].matrix : film_.matrix_at(film_.segments()[segment], frame_);
  return shape::eye_matrix(film_.camera_at(frame_).world_to_eye, matrix);
}

shape::EyeMatrix Scene::bone_matrix(std::size_t segment, std::uint32_t bone) const {
  const std::size_t number = film_.segments()[segment].first_bone + bone;
  const std::uint32_t moved = moved_at_[film_.segments().size() + number];
  const wire::Matrix& matrix = moved > 0 ? moved_[moved - 1].matrix : film_.matrix_at(film_.bones()[number], frame_);
  return shape::eye_matrix(film_.camera_at(frame_).world_to_eye, matrix);
}

std::uint32_t Scene::material(std::size_t segment) const {
  const std::uint32_t moved = moved_at_[segment];
  return moved > 0 ? moved_[moved - 1].material : film_.value_at(film_.segments()[segment].material, frame_);
}

}  // namespace mars::geometry
