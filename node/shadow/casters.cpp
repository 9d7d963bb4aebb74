#include "node/shadow/casters.h"

#include <algorithm>
#include <functional>

namespace mars::shadow {
namespace {

constexpr std::size_t kChunkBytes = std::size_t{24} << 20;
constexpr std::size_t kDicedBytes = std::size_t{48} << 20;
constexpr std::size_t kMostCasters = std::size_t{1} << 12;  // of a chunk
constexpr std::size_t kMostBytes =                          // of a caster
    (std::size_t{shape::Dicer::kMostVertices} + simd::kVectorSlack) * 3 * sizeof(float) +
    2 * ((std::size_t{2} * shape::kMaxRate * shape::kMaxRate + 4 * shape::kMaxRate + simd::kVectorSlack) *
             (3 * sizeof(std::uint32_t) + sizeof(shape::Batch)) +
         4096);
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

// How many of the batches from `first` on are rows of equally many quads, of at most `most`, which is even: 1 if none.
std::uint32_t equal_rows(const shape::Triangles& t, std::uint32_t first, std::uint32_t most) {
  const auto size = [&t](std::uint32_t b) { return t.batches[b].last - t.batches[b].first; };
  std::uint32_t rows = 0;
  while (rows < most && first + rows < t.batch_count && t.batches[first + rows].consecutive &&
         size(first + rows) == size(first))
    ++rows;
  return rows == most ? most : rows >= 2 ? 2 : 1;
}

bool casts(const geometry::Scene& scene, std::size_t segment, Casting casting) {
  return scene.moves(segment) == (casting == Casting::moving) &&
         scene.film().materials()[scene.material(segment)].casts == 1;
}

}  // namespace

CasterStore::CasterStore(std::size_t bytes, std::size_t casters) : memory_(bytes), arena_(memory_.bytes()) {
  casters_.reserve(casters);
  memory_.prefer_large_pages();
}

void CasterStore::clear() {
  arena_.clear();
  casters_.clear();
}

bool CasterStore::has_room() const { return arena_.rest().size() >= kMostBytes; }

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
  if (casters_.empty() || !same(before_)) {
    before_ = {copy(t.a, t.count), copy(t.b, t.count), copy(t.c, t.count), t.count, copy(t.batches, t.batch_count),
               t.batch_count};
    compact_ = compact(before_);
  }
  return compact_;
}

// The same triangles with their rows cut, so that those of a batch are near each other: the batches of rows of quads,
// two a row (Dicer::fill_inside), become pieces of two rows.
shape::Triangles CasterStore::compact(const shape::Triangles& t) {
  constexpr std::uint32_t kRows = 4;
  const auto batches = arena_.take<shape::Batch>(t.count);
  const std::uint32_t* const from[3] = {t.a, t.b, t.c};
  std::uint32_t* to[3];
  for (std::uint32_t*& corners : to) corners = arena_.take<std::uint32_t>(t.count + simd::kVectorSlack).data();
  std::uint32_t count = 0, next = 0;
  const auto add = [&](std::uint32_t first, std::uint32_t last) {
    for (std::size_t c = 0; c < 3; ++c) std::copy(from[c] + first, from[c] + last, to[c] + next);
    next += last - first;
  };
  for (std::uint32_t b = 0; b < t.batch_count;) {
    const std::uint32_t rows = equal_rows(t, b, kRows), width = t.batches[b].last - t.batches[b].first;
    const std::uint32_t piece = shape::kBatchTriangles / rows;
    for (std::uint32_t k = 0; k < width; k += piece) {
      const std::uint32_t first = next;
      for (std::uint32_t row = 0; row < rows; ++row)
        add(t.batches[b + row].first + k, t.batches[b + row].first + std::min(k + piece, width));
      batches[count++] = {first, next, false};
    }
    b += rows;
  }
  for (std::uint32_t* corners : to) std::fill_n(corners + next, simd::kVectorSlack, 0u);
  return {to[0], to[1], to[2], t.count, batches.data(), count};
}

const Caster& CasterStore::add(const shape::Surface& surface) {
  const shape::Vertices& v = surface.vertices();
  const auto vertices = static_cast<std::uint32_t>(surface.vertex_count());
  const shape::Triangles triangles = copy(surface.triangles());
  casters_.push_back(
      {{copy(v.place[0], vertices), copy(v.place[1], vertices), copy(v.place[2], vertices)}, vertices, triangles});
  return casters_.back();
}

DicedSurfaces::DicedSurfaces(std::uint64_t patches) : store_(kDicedBytes), place_(patches) {}

void DicedSurfaces::clear() {
  store_.clear();
  std::ranges::fill(place_, 0u);
}

void DicedSurfaces::keep(std::uint32_t patch, const shape::Surface& surface) {
  if (!store_.has_room()) return;
  store_.add(surface);
  place_[patch] = static_cast<std::uint32_t>(store_.all().size());
}

const Caster* DicedSurfaces::find(std::uint32_t patch) const {
  return place_[patch] == 0 ? nullptr : &store_.all()[place_[patch] - 1];
}

CasterStream::CasterStream(simd::InstructionSet set) : dicer_(set), placer_(set), store_(kChunkBytes, kMostCasters) {
  chunk_.reserve(kMostCasters);
}

void CasterStream::begin(const geometry::Scene& scene, Casting casting, const DicedSurfaces& diced) {
  scene_ = &scene;
  diced_ = &diced;
  casting_ = casting;
  segment_ = 0;
  item_ = 0;
}

std::span<const ChunkCaster> CasterStream::next(const Matters& matters) {
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
      if (!store_.has_room() || chunk_.size() == kMostCasters) return chunk_;
      add_item(shape, number, matters);
    }
  }
  return chunk_;
}

void CasterStream::add_item(const wire::Shape& shape, std::uint32_t number, const Matters& matters) {
  const bool is_patch = item_ < shape.patch_count;
  const auto patch = [&]() -> const wire::Patch& { return scene_->film().patches_of(number)[item_]; };
  const auto meshlet = [&]() -> const wire::Meshlet& {
    return scene_->film().meshlets_of(number)[item_ - shape.patch_count];
  };
  const Hull hull = is_patch ? hull_of(shape::to_eye(matrix_, patch())) : hull_of(matrix_, meshlet());
  if (!matters(hull)) return;
  const Caster* const known = diced_->find(scene_->first_patch(segment_) + static_cast<std::uint32_t>(item_));
  if (known != nullptr)
    chunk_.push_back({hull, known, false});
  else
    chunk_.push_back({hull, &store_.add(is_patch ? dice(patch()) : place(meshlet())), true});
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

const shape::Surface& CasterStream::dice(const wire::Patch& patch) {
  const shape::EyePatch eye_patch = shape::to_eye(matrix_, patch);
  shape::Dicing dicing = scene_->dicing();
  const auto width = static_cast<float>(scene_->width()), height = static_cast<float>(scene_->height());
  if (shape::unseen(eye_patch, scene_->projection(), width, height)) dicing.most_inside = kUnseenRate;
  dicer_.dice(eye_patch, scene_->projection(), dicing);
  return dicer_;
}

const shape::Surface& CasterStream::place(const wire::Meshlet& meshlet) {
  placer_.place(map_, scene_->film(), meshlet, scene_->projection());
  return placer_;
}

}  // namespace mars::shadow
