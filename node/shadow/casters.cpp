#include "node/shadow/casters.h"

#include <algorithm>
#include <functional>

namespace mars::shadow {
namespace {

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

// The corners of the box round the vertices.
Hull hull_of(const shape::Surface& surface) {
  float low[3], high[3];
  for (int axis = 0; axis < 3; ++axis) {
    const float* const along = surface.vertices().place[axis];
    const auto [least, greatest] = std::minmax_element(along, along + surface.vertex_count());
    low[axis] = *least, high[axis] = *greatest;
  }
  Hull hull{};
  for (int corner = 0; corner < 8; ++corner) {
    const float place[3] = {(corner & 1 ? high : low)[0], (corner & 2 ? high : low)[1], (corner & 4 ? high : low)[2]};
    add_point(place, hull);
  }
  return hull;
}

bool casts(const geometry::Scene& scene, std::size_t segment, Casting casting) {
  return scene.moves(segment) == (casting == Casting::moving) &&
         scene.film().materials()[scene.material(segment)].casts == 1;
}

}  // namespace

static_assert(sizeof(Caster) <= CasterStore::kBytesACaster / 4, "a quarter of the bytes is for the list");

CasterStore::CasterStore(std::size_t bytes)
    : most_(bytes / kBytesACaster), memory_(bytes - most_ * sizeof(Caster)), arena_(memory_.bytes()) {
  casters_.reserve(most_);
  memory_.prefer_large_pages();
}

void CasterStore::clear() {
  arena_.clear();
  casters_.clear();
}

bool CasterStore::has_room() const { return arena_.rest().size() >= kMostBytes && casters_.size() < most_; }

template <typename T>
const T* CasterStore::copy(const T* from, std::size_t count) {
  const auto to = arena_.take<T>(count + simd::kVectorSlack);
  std::copy_n(from, count, to.data());
  std::fill_n(to.data() + count, simd::kVectorSlack, T{});
  return to.data();
}

// Many surfaces have the triangles of the one before.
shape::Triangles CasterStore::copy(const shape::Triangles& t) {
  const auto same = [&t](const shape::Triangles& other) {
    const auto are_equal = [&t](const std::uint32_t* one, const std::uint32_t* two) {
      return std::equal(one, one + t.count, two);
    };
    return other.count == t.count && other.batch_count == t.batch_count && are_equal(t.a, other.a) &&
           are_equal(t.b, other.b) && are_equal(t.c, other.c);
  };
  if (!casters_.empty() && same(casters_.back().triangles)) return casters_.back().triangles;
  return {copy(t.a, t.count), copy(t.b, t.count), copy(t.c, t.count), t.count, copy(t.batches, t.batch_count),
          t.batch_count};
}

const Caster& CasterStore::add(const shape::Surface& surface, const Hull& hull) {
  const shape::Vertices& v = surface.vertices();
  const auto vertices = static_cast<std::uint32_t>(surface.vertex_count());
  const shape::Triangles triangles = copy(surface.triangles());
  casters_.push_back({hull,
                      {copy(v.place[0], vertices), copy(v.place[1], vertices), copy(v.place[2], vertices)},
                      vertices,
                      triangles});
  return casters_.back();
}

DicedSurfaces::DicedSurfaces(std::uint64_t patches, std::size_t bytes) : store_(bytes), place_(patches) {}

void DicedSurfaces::clear() {
  store_.clear();
  std::ranges::fill(place_, 0u);
}

void DicedSurfaces::keep(std::uint32_t patch, const shape::Surface& surface) {
  if (!store_.has_room()) return;
  store_.add(surface, hull_of(surface));
  place_[patch] = static_cast<std::uint32_t>(store_.all().size());
}

const Caster* DicedSurfaces::find(std::uint32_t patch) const {
  return place_[patch] == 0 ? nullptr : &store_.all()[place_[patch] - 1];
}

CasterStream::CasterStream(simd::InstructionSet set, std::size_t bytes) : dicer_(set), placer_(set), store_(bytes) {
  chunk_.reserve(store_.most());
}

void CasterStream::begin(const geometry::Scene& scene, Casting casting, const DicedSurfaces& diced) {
  scene_ = &scene;
  diced_ = &diced;
  casting_ = casting;
  segment_ = 0;
  item_ = 0;
}

std::span<const Caster* const> CasterStream::next(const Matters& matters) {
  store_.clear();
  chunk_.clear();
  const wire::PackedFilm& film = scene_->film();
  for (; segment_ < film.segments().size(); ++segment_, item_ = 0) {
    if (!casts(*scene_, segment_, casting_)) continue;
    const std::uint32_t number = film.segments()[segment_].shape;
    const wire::Shape& shape = film.shape(number);
    matrix_ = scene_->matrix(segment_);
    map_ = geometry::eye_map(matrix_);
    for (; item_ < shape.size(); ++item_) {
      if (!store_.has_room() || chunk_.size() == store_.most()) return chunk_;
      add_item(shape, number, matters);
    }
  }
  return chunk_;
}

bool CasterStream::has_diced(const Caster& caster) const {
  const std::span<const Caster> here = store_.all();
  return !here.empty() && !std::less<>()(&caster, &here.front()) && !std::less<>()(&here.back(), &caster);
}

void CasterStream::add_item(const wire::Shape& shape, std::uint32_t number, const Matters& matters) {
  const auto patch = scene_->first_patch(segment_) + static_cast<std::uint32_t>(item_);
  if (const Caster* known = diced_->find(patch)) {
    if (matters(known->hull)) chunk_.push_back(known);
  } else if (item_ < shape.patch_count) {
    add_patch(scene_->film().patches_of(number)[item_], matters);
  } else {
    add_meshlet(scene_->film().meshlets_of(number)[item_ - shape.patch_count], matters);
  }
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
  chunk_.push_back(&store_.add(surface, hull));
}

}  // namespace mars::shadow
