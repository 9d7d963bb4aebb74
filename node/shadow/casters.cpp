#include "node/shadow/casters.h"

#include <algorithm>
#include <utility>

#include "hal/failure/failure.h"

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

Hull hull_of(const geometry::BoxCorners& corners) {
  Hull hull{};
  for (const auto& point : corners.point) add_point(point, hull);
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

// Batches whose triangles are near each other: those of rows of quads, two a row (Dicer::fill_inside), are cut into
// pieces of two rows. Calls visit(first, last, at, ends) for triangles that come to place `at`, and whether a batch
// ends there, as long as it says true; there are not more batches than before.
template <typename Visit>
bool visit_compact(const shape::Triangles& t, const Visit& visit) {
  constexpr std::uint32_t kRows = 4;
  std::uint32_t at = 0;
  for (std::uint32_t b = 0; b < t.batch_count;) {
    const std::uint32_t rows = equal_rows(t, b, kRows), width = t.batches[b].last - t.batches[b].first;
    const std::uint32_t piece = shape::kBatchTriangles / rows;
    for (std::uint32_t k = 0; k < width; k += piece)
      for (std::uint32_t row = 0; row < rows; ++row) {
        const std::uint32_t first = t.batches[b + row].first, some = std::min(piece, width - k);
        if (!visit(first + k, first + k + some, at, row + 1 == rows)) return false;
        at += some;
      }
    b += rows;
  }
  return true;
}

// Whether `compact` has the triangles of `t` so.
bool is_compact(const shape::Triangles& compact, const shape::Triangles& t) {
  if (compact.count != t.count) return false;
  return visit_compact(t, [&](std::uint32_t first, std::uint32_t last, std::uint32_t at, bool) {
    return std::equal(t.a + first, t.a + last, compact.a + at) && std::equal(t.b + first, t.b + last, compact.b + at) &&
           std::equal(t.c + first, t.c + last, compact.c + at);
  });
}

bool casts(const geometry::Scene& scene, std::size_t segment, Casting casting) {
  return (casting == Casting::moving ? scene.moves(segment) : scene.stands(segment)) &&
         scene.film().materials()[scene.material(segment)].casts == 1;
}

// Whether the piece moves, or stands still, as `casting` says.
bool is_of(Casting casting, const geometry::Scene& scene, std::size_t segment, std::size_t piece) {
  return scene.moves(segment, piece) == (casting == Casting::moving);
}

}  // namespace

CasterStore::CasterStore(std::size_t bytes, std::size_t beside)
    : most_(bytes / kBytesACaster), memory_(bytes - most_ * (sizeof(Caster) + beside)), arena_(memory_.bytes()) {
  check((sizeof(Caster) + beside) * 8 <= kBytesACaster * 3, "three eighths of the bytes are for lists");
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
  if (!casters_.empty() && is_compact(casters_.back().triangles, t)) return casters_.back().triangles;
  const auto batches = arena_.take<shape::Batch>(t.batch_count);
  std::uint32_t* to[3];
  for (std::uint32_t*& corners : to) corners = arena_.take<std::uint32_t>(t.count + simd::kVectorSlack).data();
  std::uint32_t count = 0, begin = 0;
  visit_compact(t, [&](std::uint32_t first, std::uint32_t last, std::uint32_t at, bool ends) {
    const std::uint32_t* const from[3] = {t.a, t.b, t.c};
    for (std::size_t c = 0; c < 3; ++c) std::copy(from[c] + first, from[c] + last, to[c] + at);
    if (ends) batches[count++] = {std::exchange(begin, at + last - first), at + last - first, false};
    return true;
  });
  for (std::uint32_t* corners : to) std::fill_n(corners + t.count, simd::kVectorSlack, 0u);
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

// Of the bytes, movers get a quarter: they are diced again in each frame, whatever is kept of them.
DicedSurfaces::DicedSurfaces(std::uint64_t patches, std::size_t bytes)
    : still_{CasterStore(bytes - bytes / 4), {}}, moving_{CasterStore(bytes / 4), {}}, kept_(patches) {
  for (Kind* kind : {&still_, &moving_}) kind->patches.reserve(kind->store.most());
}

void DicedSurfaces::clear(Casting kind) {
  Kind& some = of(kind);
  for (const std::uint32_t patch : some.patches) kept_[patch] = nullptr;
  some.patches.clear();
  some.store.clear();
}

const Caster* DicedSurfaces::keep(Casting kind, std::uint32_t patch, const shape::Surface& surface) {
  Kind& some = of(kind);
  if (kept_[patch] == nullptr && some.store.has_room()) {
    kept_[patch] = &some.store.add(surface);
    some.patches.push_back(patch);
  }
  return kept_[patch];
}

// A caster has a place in the chunk too; and one among those that shafts meet, with its batches, about sixteen.
CasterStream::CasterStream(simd::InstructionSet set, std::size_t bytes)
    : dicer_(set), placer_(set), store_(bytes, sizeof(ChunkCaster) + sizeof(Caster) + 16 * sizeof(shape::Batch)) {
  chunk_.reserve(store_.most());
}

void CasterStream::begin(const geometry::Scene& scene, Casting casting, DicedSurfaces& diced) {
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
    place_.find(*scene_, segment_);
    for (; item_ < shape.size(); ++item_) {
      if (!is_of(casting_, *scene_, segment_, item_)) continue;
      if (!store_.has_room() || chunk_.size() == store_.most()) return chunk_;
      add_item(shape, number, matters);
    }
  }
  return chunk_;
}

void CasterStream::add_item(const wire::Shape& shape, std::uint32_t number, const Matters& matters) {
  const bool is_patch = item_ < shape.patch_count;
  const auto meshlet = [&]() -> const wire::Meshlet& {
    return scene_->film().meshlets_of(number)[item_ - shape.patch_count];
  };
  const Hull hull =
      is_patch ? hull_of(place_.patch(scene_->film(), item_)) : hull_of(place_.corners(scene_->film(), meshlet()));
  if (!matters(hull)) return;
  const auto number_of_all = scene_->first_patch(segment_) + static_cast<std::uint32_t>(item_);
  const Caster* const known = diced_->find(number_of_all);
  const Caster& surface = known != nullptr ? *known : add(number_of_all, is_patch ? dice(item_) : place(meshlet()));
  chunk_.push_back({hull, &surface, number_of_all, known == nullptr});
}

const Caster& CasterStream::add(std::uint32_t patch, const shape::Surface& surface) {
  const Caster* const kept = casting_ == Casting::still ? diced_->keep(casting_, patch, surface) : nullptr;
  return kept != nullptr ? *kept : store_.add(surface);
}

void CasterStream::visit_hulls(const geometry::Scene& scene, Casting casting,
                               const std::function<void(const Hull&)>& visit) {
  const wire::PackedFilm& film = scene.film();
  for (std::size_t s = 0; s < film.segments().size(); ++s) {
    if (!casts(scene, s, casting)) continue;
    const std::uint32_t number = film.segments()[s].shape;
    place_.find(scene, s);
    const std::size_t patches = film.patches_of(number).size();
    const auto meshlets = film.meshlets_of(number);
    for (std::size_t piece = 0; piece < film.shape(number).size(); ++piece)
      if (is_of(casting, scene, s, piece))
        visit(piece < patches ? hull_of(place_.patch(film, piece))
                              : hull_of(place_.corners(film, meshlets[piece - patches])));
  }
}

const shape::Surface& CasterStream::dice(std::size_t patch) {
  const shape::EyePatch eye_patch = place_.patch(scene_->film(), patch);
  shape::Dicing dicing = scene_->dicing();
  // Of the whole picture, whichever part is drawn: shadows do not depend on it.
  const wire::FilmSettings& settings = scene_->film().settings();
  shape::Projection whole = scene_->projection();
  std::fill_n(whole.origin, 2, 0);
  const auto width = static_cast<float>(settings.whole_width()), height = static_cast<float>(settings.whole_height());
  if (shape::unseen(eye_patch, whole, width, height)) dicing.most_inside = kUnseenRate;
  dicer_.dice(eye_patch, scene_->projection(), dicing);
  return dicer_;
}

const shape::Surface& CasterStream::place(const wire::Meshlet& meshlet) {
  placer_.place(place_, scene_->film(), meshlet, scene_->projection());
  return placer_;
}

}  // namespace mars::shadow
