#include "node/shadow/points.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

namespace mars::shadow {
namespace {

constexpr float kFar = std::numeric_limits<float>::max();
constexpr float kDigits = 128;  // grid steps that a float of a place may be off
}  // namespace

const GridBox kNowhere{std::numeric_limits<std::int32_t>::max(),
                       -std::numeric_limits<std::int32_t>::max(),
                       std::numeric_limits<std::int32_t>::max(),
                       -std::numeric_limits<std::int32_t>::max(),
                       kFar,
                       -kFar};

const GridBox kEverywhere{kNowhere.high_x, kNowhere.low_x, kNowhere.high_y, kNowhere.low_y, -kFar, kFar};

GridBox around(const GridBox& a, const GridBox& b) {
  return {std::min(a.low_x, b.low_x),   std::max(a.high_x, b.high_x), std::min(a.low_y, b.low_y),
          std::max(a.high_y, b.high_y), std::min(a.low_z, b.low_z),   std::max(a.high_z, b.high_z)};
}

TileLines lines_of(const Layer& layer, std::uint32_t top) {
  TileLines lines{};
  for (std::uint32_t k = 0; k < kTile; ++k)
    if (layer.range.has(top + k) && layer.line(top + k).depth != nullptr) lines[k] = &layer.line(top + k);
  return lines;
}

std::uint32_t far_ones(const PointFrame& frame, const float* depths, std::uint32_t active) {
  constexpr float kMostApart = 1.1f;
  constexpr float kMostPixelsApart = 64;  // in parallel projection
  float least = std::numeric_limits<float>::max(), greatest = frame.nothing;
  for (std::uint32_t left = active; left != 0; left &= left - 1) {
    const float here = depths[std::countr_zero(left)];
    least = std::min(least, here), greatest = std::max(greatest, here);
  }
  const bool are_near =
      frame.parallel ? greatest - least <= kMostPixelsApart / frame.scale : greatest <= kMostApart * least;
  if (are_near) return 0;
  std::uint32_t far = 0;
  for (std::uint32_t left = active; left != 0; left &= left - 1)
    if (depths[std::countr_zero(left)] < (least + greatest) / 2) far |= left & -left;
  return far;
}

void BoxTree::Level::clear() {
  for (auto* bound : {&low_x, &high_x, &low_y, &high_y, &low_z}) bound->clear();
  last = kNowhere;
}

void BoxTree::Level::add(const GridBox& box) {
  low_x.push_back(static_cast<float>(box.low_x) - kDigits), high_x.push_back(static_cast<float>(box.high_x) + kDigits);
  low_y.push_back(static_cast<float>(box.low_y) - kDigits), high_y.push_back(static_cast<float>(box.high_y) + kDigits);
  low_z.push_back(box.low_z);
  last = around(last, box);
}

void BoxTree::Level::fill_last() {
  const GridBox round = last;
  while (size() % kPointLanes != 0) add(kNowhere);
  last = round;
}

void BoxTree::clear() {
  for (Level& level : levels_) level.clear();
  count_ = 0;
}

std::size_t BoxTree::bytes() const {
  std::size_t bytes = 0;
  for (const Level& level : levels_) bytes += 5 * level.low_z.capacity() * sizeof(float);
  for (const auto& found : found_) bytes += found.capacity() * sizeof(std::uint32_t);
  return bytes;
}

void BoxTree::add(const GridBox& box) {
  add(0, box);
  ++count_;
}

void BoxTree::add(std::size_t level, const GridBox& box) {
  levels_[level].add(box);
  if (level + 1 == kLevels || levels_[level].size() % kPointLanes != 0) return;
  add(level + 1, std::exchange(levels_[level].last, kNowhere));
}

void BoxTree::finish() {
  for (std::size_t level = 0; level < kLevels; ++level) {
    if (levels_[level].size() % kPointLanes == 0) continue;
    levels_[level].fill_last();
    if (level + 1 < kLevels) add(level + 1, levels_[level].last);
  }
}

bool BoxTree::any(const ShadowKernels& kernels, const GridBox& box, float spread) {
  constexpr std::size_t kRoughly = 1;  // of the boxes round sixteen
  return find_at(kernels, kRoughly, box, spread, found_[0]) > 0;
}

std::span<const std::uint32_t> BoxTree::find(const ShadowKernels& kernels, const GridBox& box, float spread,
                                             std::vector<std::uint32_t>& found) {
  const std::uint32_t count = find_at(kernels, 0, box, spread, found);
  return std::span(std::as_const(found)).first(count);
}

// From the top down to `level`.
std::uint32_t BoxTree::find_at(const ShadowKernels& kernels, std::size_t level, const GridBox& box, float spread,
                               std::vector<std::uint32_t>& found) {
  const Level& here = levels_[level];
  if (found.size() < here.size()) found.resize(here.size());
  if (level + 1 == kLevels) return kernels.find(here.view(), 0, here.size(), box, spread, found.data());
  std::vector<std::uint32_t>& above = found_[level];
  const std::uint32_t count = find_at(kernels, level + 1, box, spread, above);
  std::uint32_t next = 0;
  for (std::uint32_t k = 0; k < count; ++k)
    next += kernels.find(here.view(), above[k] * kPointLanes, kPointLanes, box, spread, found.data() + next);
  return next;
}

void Points::clear() {
  vectors_.clear();
  origins_.clear();
  tree_.clear();
  count_ = 0;
}

std::size_t Points::bytes() const {
  return vectors_.capacity() * sizeof(PointVector) + origins_.capacity() * sizeof(Origin) + tree_.bytes();
}

void Points::add(Layer& layer, std::uint32_t tile, std::uint32_t vector, const PointVector& points) {
  vectors_.push_back(points);
  origins_.push_back({&layer, tile, vector});
  tree_.add(points.box);
  count_ += static_cast<std::uint64_t>(std::popcount(points.active));
}

void add_points(const PointSource& source, std::span<const LightView> views, Layer& layer, const TilePart& part,
                std::span<Points> points) {
  const auto counts = [&part](const wire::StillPairs& pairs, const Lane& lane, std::uint16_t moved) {
    const std::uint32_t open = pairs.lit & ~(pairs.blocked | moved);
    return ((open >> lane.pair) & (part.squares >> lane.square()) & 1) != 0;
  };
  for_each_vector(source, layer, part.tile, counts, views,
                  [&](const PointVector& some, std::uint32_t vector, std::size_t view) {
                    points[view].add(layer, part.tile, vector, some);
                  });
}

void Points::note(const PointSource& source, Casting casting) {
  for (std::size_t i = 0; i < vectors_.size(); ++i) {
    const Origin& from = origins_[i];
    Layer& layer = *from.layer;
    const std::size_t of_light = std::size_t{source.light} * layer.width;
    const std::uint32_t left = from.tile % layer.tiles_across() * kTile, top = from.tile / layer.tiles_across() * kTile;
    const VectorLanes& lanes = source.vectors.lanes(source.light_point, from.vector);
    const std::uint32_t fresh = vectors_[i].blocked & ~std::exchange(vectors_[i].noted, vectors_[i].blocked);
    for (std::uint32_t bits = fresh; bits != 0; bits &= bits - 1) {
      const Lane lane = lanes.lane[static_cast<std::size_t>(std::countr_zero(bits))];
      LayerLine& line = layer.line(top + lane.line);
      const std::size_t at = of_light + left + lane.column;
      std::uint16_t& blocked = casting == Casting::still ? line.pairs[at].blocked : line.moved[at];
      blocked = static_cast<std::uint16_t>(blocked | 1u << lane.pair);
      line.is_changed |= casting == Casting::moving;
    }
  }
}

}  // namespace mars::shadow
