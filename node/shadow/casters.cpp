#include "node/shadow/casters.h"

#include <algorithm>

namespace mars::shadow {
namespace {

constexpr std::size_t kChunkBytes = std::size_t{24} << 20;
constexpr int kUnseenRate = 32;  // of the inside of patches that no pixel shows

void add_point(const float* place, Hull& hull) {
  for (int axis = 0; axis < 3; ++axis) hull.along[axis][hull.count] = place[axis];
  ++hull.count;
}

Hull hull_of(const shape::EyePatch& patch) {
  Hull hull{};
  for (const auto& point : patch.point) add_point(point, hull);
  return hull;
}

Hull hull_of(const shape::EyeMatrix& matrix, const wire::Meshlet& meshlet) {
  Hull hull{};
  for (int corner = 0; corner < 8; ++corner) {
    const auto along = [&](std::size_t axis) { return (corner >> axis & 1 ? meshlet.high : meshlet.low)[axis]; };
    float place[3];
    shape::to_eye(matrix, {along(0), along(1), along(2)}, place);
    add_point(place, hull);
  }
  return hull;
}

bool casts(const geometry::Scene& scene, std::size_t segment, Casting casting) {
  return scene.moves(segment) == (casting == Casting::moving) &&
         scene.film().materials()[scene.material(segment)].casts == 1;
}

}  // namespace

const std::size_t CasterStream::kMostBytes =
    (std::size_t{shape::Dicer::kMostVertices} + simd::kVectorSlack) * 3 * sizeof(float) +
    (std::size_t{2} * shape::kMaxRate * shape::kMaxRate + 4 * shape::kMaxRate + simd::kVectorSlack) * 3 *
        sizeof(std::uint32_t) +
    std::size_t{2} * shape::kMaxRate * shape::kMaxRate * sizeof(shape::Batch) / 8 + 4096;

CasterStream::CasterStream(simd::InstructionSet set)
    : dicer_(set), placer_(set), memory_(kChunkBytes), arena_(memory_.bytes()) {}

void CasterStream::begin(const geometry::Scene& scene, Casting casting) {
  scene_ = &scene;
  casting_ = casting;
  segment_ = 0;
  item_ = 0;
}

std::span<const Caster> CasterStream::next(const Matters& matters) {
  arena_.clear();
  chunk_.clear();
  const wire::PackedFilm& film = scene_->film();
  for (; segment_ < film.segments().size(); ++segment_, item_ = 0) {
    if (!casts(*scene_, segment_, casting_)) continue;
    const std::uint32_t number = film.segments()[segment_].shape;
    const wire::Shape& shape = film.shape(number);
    matrix_ = scene_->matrix(segment_);
    map_ = geometry::eye_map(matrix_);
    for (; item_ < shape.size(); ++item_) {
      if (is_full()) return chunk_;
      if (item_ < shape.patch_count)
        add_patch(film.patches_of(number)[item_], matters);
      else
        add_meshlet(film.meshlets_of(number)[item_ - shape.patch_count], matters);
    }
  }
  return chunk_;
}

void CasterStream::visit_hulls(const geometry::Scene& scene, Casting casting,
                               const std::function<void(const Hull&)>& visit) const {
  const wire::PackedFilm& film = scene.film();
  for (std::size_t s = 0; s < film.segments().size(); ++s) {
    if (!casts(scene, s, casting)) continue;
    const std::uint32_t number = film.segments()[s].shape;
    const shape::EyeMatrix matrix = scene.matrix(s);
    for (const wire::Patch& patch : film.patches_of(number)) visit(hull_of(shape::to_eye(matrix, patch)));
    for (const wire::Meshlet& meshlet : film.meshlets_of(number)) visit(hull_of(matrix, meshlet));
  }
}

void CasterStream::add_patch(const wire::Patch& patch, const Matters& matters) {
  const shape::EyePatch eye_patch = shape::to_eye(matrix_, patch);
  const Hull hull = hull_of(eye_patch);
  if (!matters(hull)) return;
  shape::Dicing dicing = scene_->dicing();
  const auto width = static_cast<float>(scene_->width()), height = static_cast<float>(scene_->height());
  if (shape::unseen(eye_patch, scene_->projection(), width, height)) dicing.most_inside = kUnseenRate;
  dicer_.dice(eye_patch, scene_->projection(), dicing);
  add(dicer_, hull);
}

void CasterStream::add_meshlet(const wire::Meshlet& meshlet, const Matters& matters) {
  const Hull hull = hull_of(matrix_, meshlet);
  if (!matters(hull)) return;
  placer_.place(map_, scene_->film(), meshlet, scene_->projection());
  add(placer_, hull);
}

void CasterStream::add(const shape::Surface& surface, const Hull& hull) {
  const auto copy = [&]<typename T>(const T* from, std::size_t count) -> const T* {
    const auto to = arena_.take<T>(count + simd::kVectorSlack);
    std::copy_n(from, count, to.data());
    std::fill_n(to.data() + count, simd::kVectorSlack, T{});
    return to.data();
  };
  const shape::Vertices& v = surface.vertices();
  const shape::Triangles& t = surface.triangles();
  const auto vertices = static_cast<std::uint32_t>(surface.vertex_count());
  chunk_.push_back({hull,
                    {copy(v.place[0], vertices), copy(v.place[1], vertices), copy(v.place[2], vertices)},
                    vertices,
                    {copy(t.a, t.count), copy(t.b, t.count), copy(t.c, t.count), t.count,
                     copy(t.batches, t.batch_count), t.batch_count}});
}

}  // namespace mars::shadow
