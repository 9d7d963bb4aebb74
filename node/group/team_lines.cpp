#include "node/group/team_lines.h"

#include <algorithm>
#include <cmath>

#include "node/geometry/picture_box.h"
#include "node/group/mapping.h"

namespace mars::group {
namespace {

// Nanoseconds, about, as nodes take them on the reference machine. All nodes take the same, so that they map alike.
constexpr double kPiece = 2000, kQuad = 20;  // of a patch that is diced, and of each of its quads
constexpr double kBox = 15;                  // of an edge box, from the dicing to the drawing
constexpr double kSample = 2;                // that moving parts cover, or their shadows may
constexpr double kEncodedByte = 1;
constexpr double kUsualRate = 8;  // steps of a patch's side, where the film does not say

geometry::PictureSize size_of(const geometry::Scene& scene) {
  return {static_cast<std::uint32_t>(scene.width()), static_cast<std::uint32_t>(scene.height())};
}

}  // namespace

TeamLines::TeamLines(std::size_t lines, std::size_t most) : steps_(lines + 1), totals_(lines + 1), ranges_(most) {}

std::span<const geometry::LineRange> TeamLines::divide(const geometry::Scene& scene, const geometry::ShapeBoxes& boxes,
                                                       const geometry::LineRange& touched, std::size_t nodes,
                                                       const FileBands& bands) {
  std::ranges::fill(steps_, std::uint64_t{0});
  points_ = 0;
  for (const std::uint32_t segment : scene.movers()) add_segment(scene, segment, boxes, nodes);
  if (scene.casting_count() > 0) add({touched, {0, static_cast<std::uint32_t>(scene.width()) / 4}}, 0, scene);
  add_up_bands(bands);
  const auto ranges = std::span(ranges_).first(nodes);
  map_optimal(totals_, ranges);
  const auto lines = static_cast<std::uint32_t>(scene.height());
  for (geometry::LineRange& range : ranges)
    range = {std::min(range.first * bands.lines, lines), std::min(range.last * bands.lines, lines)};
  return ranges;
}

// Parts that are small beside what a node draws are taken whole, others piece by piece.
void TeamLines::add_segment(const geometry::Scene& scene, std::uint32_t segment, const geometry::ShapeBoxes& boxes,
                            std::size_t nodes) {
  const wire::PackedFilm& film = scene.film();
  const std::uint32_t number = film.segments()[segment].shape;
  place_.find(scene, segment);
  const geometry::PictureBounds all = geometry::picture_box(place_.corners(boxes), scene.projection(), size_of(scene));
  points_ += 8;
  if (all.lines.count() == 0) return;
  if (all.lines.count() * 4 * nodes <= static_cast<std::size_t>(scene.height()))
    return add(all, scene.moving_pieces(segment), scene);
  std::size_t piece_number = 0;
  for (std::size_t patch = 0; patch < film.patches_of(number).size(); ++patch) {
    if (!scene.moves(segment, piece_number++)) continue;
    const shape::EyePatch piece = place_.patch(film, patch);
    add(geometry::picture_box(piece.point, 16, scene.projection(), size_of(scene)), 1, scene);
    points_ += 16;
  }
  for (const wire::Meshlet& meshlet : film.meshlets_of(number)) {
    if (!scene.moves(segment, piece_number++)) continue;
    add(geometry::picture_box(place_.corners(film, meshlet), scene.projection(), size_of(scene)), 1, scene);
    points_ += 8;
  }
}

// Of `pieces` that lie evenly within the bounds, half of them behind the others.
void TeamLines::add(const geometry::PictureBounds& bounds, double pieces, const geometry::Scene& scene) {
  const double lines = bounds.lines.count(), samples = scene.pattern().count;
  if (lines == 0) return;
  const int fixed = scene.dicing().fixed_rate;
  const double rate = fixed > 0 ? fixed : kUsualRate;
  const double dicing = pieces * (kPiece + kQuad * rate * rate) / lines;
  const double boxes = kBox * 2 * rate * std::sqrt(2 * pieces) * samples;
  const double columns = bounds.columns.last - bounds.columns.first;
  const auto weight = static_cast<std::uint64_t>(dicing + boxes + kSample * columns * samples);
  steps_[bounds.lines.first] += weight;
  steps_[bounds.lines.last] -= weight;
}

void TeamLines::add_up_bands(const FileBands& bands) {
  const std::size_t lines = steps_.size() - 1;
  std::uint64_t weight = 0;  // of a line
  totals_.assign(1, 0);
  for (std::size_t first = 0; first < lines; first += bands.lines) {
    const std::size_t last = std::min(lines, first + bands.lines);
    std::uint64_t band = 0;
    for (std::size_t line = first; line < last; ++line) band += weight += steps_[line];
    if (band > 0) band += static_cast<std::uint64_t>(kEncodedByte) * bands.line_bytes * (last - first);
    totals_.push_back(totals_.back() + band);
  }
}

}  // namespace mars::group
