#include "tests/bench/tables/machine1992/share.h"

#include <span>

#include "node/simd/instruction_set.h"

namespace mars::machine1992 {
namespace {

void append(const raster::Polygons& polygons, std::span<const raster::UnsortedEdgeBox> boxes,
            std::vector<SentBox>& to) {
  for (auto box = boxes.rbegin(); box != boxes.rend(); ++box)  // the latest is the first of them
    to.push_back({polygons.triangles[box->box.triangle], box->line, static_cast<std::uint16_t>(box->box.first),
                  static_cast<std::uint16_t>(box->box.last()), box->moving});
}

}  // namespace

Share::Share(const wire::PackedFilm& film)
    : tessellator_(simd::best_instruction_set("")),
      crossings_(film),
      all_lines_(film.settings().height, 1),
      loads_(film.settings().height),
      memory_(std::size_t{1} << 14) {}

const std::vector<SentBox>& Share::edge_boxes(const geometry::Scene& scene, const node::Scatter& scatter,
                                              bool stationary, WorkCounts& work) {
  wire::WorkCounts counts{};
  const node::Tessellation own = tessellate(scene, scatter, stationary, counts);
  crossings_.count(scene, scatter, stationary);
  boxes_.clear();
  append(own.polygons, own.polygons.stationary, boxes_);
  append(own.polygons, own.polygons.moving, boxes_);
  append_empty(false);
  append_empty(true);
  work[Work::vertex] += counts.vertices;
  work[Work::polygon] += crossings_.polygons();
  work[Work::set_up] += crossings_.drawn();
  work[Work::edge_box] += boxes_.size();
  return boxes_;
}

// An edge box of no pixel for each crossing that has none yet.
void Share::append_empty(bool moving) {
  const std::span<std::uint32_t> lines = crossings_.on_lines(moving);
  for (const SentBox& box : boxes_)
    if ((box.moving == 1) == moving && lines[box.line] > 0) --lines[box.line];
  for (std::size_t line = 0; line < lines.size(); ++line)
    boxes_.insert(boxes_.end(), lines[line], {{}, static_cast<std::uint16_t>(line), 0, 0, moving});
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
