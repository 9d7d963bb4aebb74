#include "node/raster/pixel_groups.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <span>

#include "node/geometry/surface_view.h"
#include "node/raster/coverage.h"
#include "node/simd/vector_slack.h"

namespace mars::raster {

PixelGroups::PixelGroups(simd::InstructionSet set, std::size_t width, std::uint32_t samples)
    : kernels_(raster_kernels(set)),
      shading_kernels_(shading::shading_kernels(set)),
      color_kernels_(color::color_kernels(set)),
      width_(width),
      samples_(samples),
      fragments_(width * samples + 2 * simd::kVectorSlack),
      masks_(fragments_.size()),
      pixels_(fragments_.size()) {
  for (auto& channel : light_) channel.resize(fragments_.size());
}

shading::ShadedCounts PixelGroups::shade(const shading::Shading& shading, const LineSamples& seen, std::uint32_t line,
                                         const shading::Extent& extent) {
  group(shading, seen, extent);
  if (count() == 0) return {};
  return shading_kernels_.shade_fragments(shading, fragments_.data(), count(), line, light().channel);
}

void PixelGroups::group(const shading::Shading& shading, const LineSamples& seen, const shading::Extent& extent) {
  counts_ = {0, 0};
  if (extent.first < extent.last) counts_ = kernels_.group(shading.pattern, seen, extent, groups());
}

void PixelGroups::copy_to(const Groups& out) const {
  std::copy_n(fragments_.data(), count(), out.fragments);
  std::copy_n(masks_.data(), count(), out.masks);
  std::copy_n(pixels_.data(), count(), out.pixels);
}

void PixelGroups::restore(const GroupCounts& counts, const Groups& from) {
  counts_ = counts;
  std::copy_n(from.fragments, count(), fragments_.data());
  std::copy_n(from.masks, count(), masks_.data());
  std::copy_n(from.pixels, count(), pixels_.data());
}

std::uint32_t PixelGroups::count_on(MarkedTiles marked) const {
  return static_cast<std::uint32_t>(
      std::ranges::count_if(std::span(fragments_).first(count()),
                            [&](const shading::Fragment& group) { return has_column(marked, group.column); }));
}

void PixelGroups::copy_to(const StillGroups& still, const shading::Shading& shading, std::uint32_t line,
                          MarkedTiles marked) const {
  copy_some(still, shading, line, [&](std::uint32_t column) { return has_column(marked, column); });
}

void PixelGroups::copy_to(const StillGroups& still, const shading::Shading& shading, std::uint32_t line) const {
  copy_some(still, shading, line, [](std::uint32_t) { return true; });
}

template <typename Has>
void PixelGroups::copy_some(const StillGroups& still, const shading::Shading& shading, std::uint32_t line,
                            const Has& has) const {
  std::fill_n(still.end, width_, 0u);
  for (std::uint32_t k = 0; k < count(); ++k) still.end[fragments_[k].column] += has(fragments_[k].column) ? 1 : 0;
  std::exclusive_scan(still.end, still.end + width_, still.end, 0u);
  for (std::uint32_t k = 0; k < count(); ++k) {
    const std::uint32_t column = fragments_[k].column;
    if (!has(column)) continue;
    const std::uint32_t at = still.end[column]++;
    still.groups[at] = {{light_[0][k], light_[1][k], light_[2][k]}, masks_[k]};
    if (still.surfaces != nullptr) still.surfaces[at] = point_of(shading, fragments_[k], line);
  }
}

wire::SurfacePoint point_of(const shading::Shading& shading, const shading::Fragment& group, std::uint32_t line) {
  return shading.surfaces->at(shading.triangles[group.triangle],
                              group.column * shape::kSubpixels + shading.pattern.x[group.sample],
                              static_cast<std::int32_t>(line) * shape::kSubpixels + shading.pattern.y[group.sample]);
}

Light PixelGroups::unshadowed() {
  for (auto& channel : unshadowed_) channel.resize(fragments_.size());
  return light_of(unshadowed_);
}

// Before the groups are used up.
void PixelGroups::gather_layers(const shading::Shading& shading, std::uint32_t line, bool with_motion) {
  has_layers_ = shading.surfaces != nullptr;
  if (!has_layers_) return;
  layers_.begin(shading.pixels, counts_.pixels);
  for (std::uint32_t k = 0; k < count(); ++k) {
    wire::SurfacePoint point = point_of(shading, fragments_[k], line);
    if (!with_motion) std::ranges::fill(point.motion, 0.0f);
    layers_.add(k < counts_.pixels ? k : pixels_[k], static_cast<std::uint32_t>(std::popcount(masks_[k])), point);
  }
}

void PixelGroups::add_up(const shading::Shading& shading, std::uint32_t line, bool with_motion) {
  gather_layers(shading, line, with_motion);
  if (!unshadowed_[0].empty()) {
    kept_masks_.assign(masks_.begin(), masks_.begin() + count());
    kernels_.add_groups(groups(), counts_, samples_, light_of(unshadowed_));
    std::ranges::copy(kept_masks_, masks_.begin());
  }
  kernels_.add_groups(groups(), counts_, samples_, light());
}

void PixelGroups::resolve(const shading::Shading& shading, std::uint32_t line, StripBuffer::Layer& out) {
  add_up(shading, line, false);
  put(shading, line, out);
}

void PixelGroups::resolve_over(const StillGroups& still, const shading::Shading& shading, std::uint32_t line,
                               StripBuffer::Layer& out, std::span<const std::uint32_t> columns) {
  const std::uint32_t all = (1u << samples_) - 1;
  add_up(shading, line, true);
  if (!columns.empty()) add_pixels(columns);
  for (std::uint32_t pixel = 0; pixel < counts_.pixels; ++pixel)
    if (masks_[pixel] != all) add_uncovered(still, pixel);
  put(shading, line, out);
}

// Those that are not there yet, from the last on, for pixels stay in the order of columns.
void PixelGroups::add_pixels(std::span<const std::uint32_t> columns) {
  const auto is_there = [&](std::uint32_t pixels, std::uint32_t column) {
    return pixels > 0 && fragments_[pixels - 1].column >= column;
  };
  std::uint32_t more = 0;
  for (std::uint32_t here = 0; const std::uint32_t column : columns) {
    while (here < counts_.pixels && fragments_[here].column < column) ++here;
    more += here < counts_.pixels && fragments_[here].column == column ? 0 : 1;
  }
  std::uint32_t from = counts_.pixels, to = counts_.pixels += more;
  if (has_layers_) layers_.grow(to);
  for (std::size_t next = columns.size(); to > from;) {
    if (is_there(from, columns[next - 1])) {
      if (fragments_[from - 1].column == columns[next - 1]) --next;
      move_pixel(--from, --to);
    } else {
      put_empty_pixel(--to, columns[--next]);
    }
    if (next == 0) break;
  }
}

void PixelGroups::move_pixel(std::uint32_t from, std::uint32_t to) {
  fragments_[to] = fragments_[from];
  masks_[to] = masks_[from];
  for (auto* channels : {&light_, &unshadowed_})
    for (auto& channel : *channels)
      if (!channel.empty()) channel[to] = channel[from];
  if (has_layers_) layers_.move(from, to);
}

void PixelGroups::put_empty_pixel(std::uint32_t at, std::uint32_t column) {
  fragments_[at] = {shading::kNoTriangle, static_cast<std::uint16_t>(column), 0};
  masks_[at] = 0;
  for (auto* channels : {&light_, &unshadowed_})
    for (auto& channel : *channels)
      if (!channel.empty()) channel[at] = 0;
  if (has_layers_) layers_.clear(at);
}

void PixelGroups::add_uncovered(const StillGroups& still, std::uint32_t pixel) {
  const std::uint32_t covered = masks_[pixel], column = fragments_[pixel].column;
  for (std::uint32_t k = still.begin(column); k < still.end[column]; ++k) {
    const StillGroup& group = still.groups[k];
    const auto uncovered = static_cast<std::uint32_t>(std::popcount(group.samples & ~covered));
    const float weight = static_cast<float>(uncovered) / static_cast<float>(samples_);
    for (std::size_t c = 0; c < 3; ++c) light_[c][pixel] += weight * group.light[c];
    if (has_layers_) layers_.add(pixel, uncovered, still.surfaces[k]);
    if (!unshadowed_[0].empty())
      for (std::size_t c = 0; c < 3; ++c) unshadowed_[c][pixel] += weight * still.unshadowed[k].light[c];
    masks_[pixel] |= group.samples;
  }
}

void PixelGroups::encode(const shading::Shading& shading, Channels& channels, std::byte* to) {
  const Light light = light_of(channels);
  if (shading.encoding.alpha)
    divide_by_coverage(shading.encoding, masks_.data(), counts_.pixels, samples_, light);
  else
    kernels_.add_background(masks_.data(), counts_.pixels, samples_, shading.background, light);
  color_kernels_.encode(shading.encoding, light.channel, counts_.pixels, to);
  if (shading.encoding.alpha) put_alpha(shading.encoding, masks_.data(), counts_.pixels, samples_, to);
}

void PixelGroups::put(const shading::Shading& shading, std::uint32_t line, StripBuffer::Layer& out) {
  encode(shading, light_, has_layers_ ? layers_.colors() : out.next_pixel());
  if (has_layers_) {
    const bool has_unshadowed = !unshadowed_[0].empty();
    if (has_unshadowed) encode(shading, unshadowed_, layers_.unshadowed());
    layers_.write(counts_.pixels, has_unshadowed, out.next_pixel());
  }
  wire::Run* run = out.next_run();
  const shading::Fragment* fragments = fragments_.data();
  std::uint32_t runs = 0;
  for (std::uint32_t pixel = 0, end; pixel < counts_.pixels; pixel = end) {
    const std::uint16_t first = fragments[pixel].column;
    for (end = pixel + 1; end < counts_.pixels && fragments[end].column == first + (end - pixel);) ++end;
    run[runs++] = {line, first, static_cast<std::uint16_t>(end - pixel)};
  }
  out.added({runs, counts_.pixels});
}

}  // namespace mars::raster
