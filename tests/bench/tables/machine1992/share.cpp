#include "tests/bench/tables/machine1992/share.h"

#include <span>

#include "node/simd/instruction_set.h"

namespace mars::machine1992 {
namespace {

// Of the scatter's patches and meshlets, whether they are seen or not.
std::uint64_t polygons_of(const geometry::Scene& scene, const node::Scatter& scatter, bool stationary) {
  const wire::FilmView& film = scene.film();
  const std::uint64_t patch_polygons = 2ull * film.settings().dice * film.settings().dice;
  std::uint64_t polygons = 0;
  for (std::size_t s = 0; s < film.segments().size(); ++s) {
    if (!stationary && !scene.moves(s)) continue;
    const wire::Shape& shape = film.shapes()[film.segments()[s].shape];
    for (std::uint64_t i = 0; i < shape.size(); ++i) {
      if ((scene.first_patch(s) + i) % scatter.count != scatter.index) continue;
      polygons += i < shape.patch_count ? patch_polygons
                                        : film.meshlets()[shape.first_meshlet + i - shape.patch_count].triangle_count;
    }
  }
  return polygons;
}

void append(const raster::Polygons& polygons, std::span<const raster::UnsortedEdgeBox> boxes,
            std::vector<SentBox>& to) {
  for (auto box = boxes.rbegin(); box != boxes.rend(); ++box)  // the latest is the first of them
    to.push_back({polygons.triangles[box->box.triangle], box->line, static_cast<std::uint16_t>(box->box.first),
                  static_cast<std::uint16_t>(box->box.last()), box->moving});
}

}  // namespace

Share::Share(const wire::FilmView& film)
    : tessellator_(simd::best_instruction_set("")),
      all_lines_(film.settings().height, 1),
      loads_(film.settings().height),
      memory_(std::size_t{1} << 14) {}

const std::vector<SentBox>& Share::edge_boxes(const geometry::Scene& scene, const node::Scatter& scatter,
                                              bool stationary, WorkCounts& work) {
  wire::WorkCounts counts{};
  const node::Tessellation own = tessellate(scene, scatter, stationary, counts);
  work[Work::vertex] += counts.vertices;
  work[Work::polygon] += polygons_of(scene, scatter, stationary);
  work[Work::set_up] += own.made.triangles;
  work[Work::edge_box] += own.made.edge_boxes;
  boxes_.clear();
  append(own.polygons, own.polygons.stationary, boxes_);
  append(own.polygons, own.polygons.moving, boxes_);
  return boxes_;
}

// Again with more memory until all is stored.
node::Tessellation Share::tessellate(const geometry::Scene& scene, const node::Scatter& scatter, bool stationary,
                                     wire::WorkCounts& counts) {
  for (;; memory_.resize(2 * memory_.size())) {
    arena_ = raster::Arena(std::as_writable_bytes(std::span(memory_)));
    const node::LineTable lines{all_lines_, stationary ? all_lines_ : std::span<const std::uint8_t>(), loads_};
    const node::Tessellation own = tessellator_.tessellate(scene, scatter, lines, {arena_, memory_.data()}, counts);
    if (own.all_stored) return own;
  }
}

}  // namespace mars::machine1992
