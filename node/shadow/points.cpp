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

std::uint32_t far_ones(const float* inverse_w, std::uint32_t active) {
  constexpr float kMostApart = 1.1f;
  float least = std::numeric_limits<float>::max(), greatest = 0;
  for (std::uint32_t left = active; left != 0; left &= left - 1) {
    const float here = inverse_w[std::countr_zero(left)];
    least = std::min(least, here), greatest = std::max(greatest, here);
  }
  if (greatest <= kMostApart * least) return 0;
  std::uint32_t far = 0;
  for (std::uint32_t left = active; left != 0; left &= left - 1)
    if (inverse_w[std::countr_zero(left)] < (least + greatest) / 2) far |= left & -left;
  return far;
}

void BoxTree::Arrays::clear() {
  for (auto* bound : {&low_x, &high_x, &low_y, &high_y, &low_z}) bound->clear();
}

void BoxTree::Arrays::add(const GridBox& box) {
  low_x.push_back(static_cast<float>(box.low_x) - kDigits), high_x.push_back(static_cast<float>(box.high_x) + kDigits);
  low_y.push_back(static_cast<float>(box.low_y) - kDigits), high_y.push_back(static_cast<float>(box.high_y) + kDigits);
  low_z.push_back(box.low_z);
}

void BoxTree::Arrays::fill_last() {
  while (low_z.size() % kPointLanes != 0) {
    add(kNowhere);
    low_z.back() = kFar;
  }
}

void BoxTree::clear() {
  boxes_.clear(), around_.clear();
  last_ = kNowhere;
  count_ = 0;
}

void BoxTree::add(const GridBox& box) {
  boxes_.add(box);
  last_ = around(last_, box);
  if (++count_ % kPointLanes != 0) return;
  around_.add(last_);
  last_ = kNowhere;
}

void BoxTree::finish() {
  if (count_ % kPointLanes != 0) around_.add(last_);
  boxes_.fill_last(), around_.fill_last();
  found_around_.resize(around_.low_z.size());
}

std::uint32_t BoxTree::find_around(const ShadowKernels& kernels, const GridBox& box, float spread) {
  return kernels.find(around_.view(), 0, static_cast<std::uint32_t>(around_.low_z.size()), box, spread,
                      found_around_.data());
}

bool BoxTree::any(const ShadowKernels& kernels, const GridBox& box, float spread) {
  return find_around(kernels, box, spread) > 0;
}

std::span<const std::uint32_t> BoxTree::find(const ShadowKernels& kernels, const GridBox& box, float spread,
                                             std::vector<std::uint32_t>& into) {
  if (into.size() < boxes_.low_z.size()) into.resize(boxes_.low_z.size());
  const std::uint32_t around = find_around(kernels, box, spread);
  std::uint32_t found = 0;
  for (const std::uint32_t sixteen : std::span(found_around_).first(around))
    found += kernels.find(boxes_.view(), sixteen * kPointLanes, kPointLanes, box, spread, into.data() + found);
  return std::span(std::as_const(into)).first(found);
}

void Points::clear() {
  vectors_.clear();
  origins_.clear();
  tree_.clear();
  count_ = 0;
}

void Points::add(const PointSource& source, const LightView& view, const Layer& layer, Casting casting) {
  for (const std::uint32_t tile : layer.tiles)
    for_each_vector(
        source, layer, tile,
        [casting](const wire::StillPairs& pairs, const Lane& lane, std::uint16_t moved) {
          const std::uint32_t open = pairs.lit & ~(pairs.blocked | moved);
          return (open >> lane.pair & 1) != 0;
        },
        view,
        [&](const PointVector& points, std::uint32_t vector) {
          vectors_.push_back(points);
          origins_.push_back({&layer, tile, vector});
          tree_.add(points.box);
          count_ += static_cast<std::uint64_t>(std::popcount(points.active));
        });
}

void Points::note(const PointSource& source, Casting casting) const {
  for (std::size_t i = 0; i < vectors_.size(); ++i) {
    const Origin& from = origins_[i];
    const Layer& layer = *from.layer;
    const std::size_t of_light = std::size_t{source.light} * layer.width;
    const std::uint32_t left = from.tile % layer.tiles_across() * kTile, top = from.tile / layer.tiles_across() * kTile;
    const VectorLanes& lanes = source.vectors.lanes(source.light_point, from.vector);
    for (std::uint32_t bits = vectors_[i].blocked; bits != 0; bits &= bits - 1) {
      const Lane lane = lanes.lane[static_cast<std::size_t>(std::countr_zero(bits))];
      const LayerLine& line = layer.line(top + lane.line);
      const std::size_t at = of_light + left + lane.column;
      std::uint16_t& blocked = casting == Casting::still ? line.pairs[at].blocked : line.moved[at];
      blocked = static_cast<std::uint16_t>(blocked | 1u << lane.pair);
    }
  }
}

}  // namespace mars::shadow
