#include "node/raster/strip_buffer.h"

#include <algorithm>
#include <cstring>

#include "hal/failure/failure.h"
#include "node/wire/film_parts.h"

namespace mars::raster {
namespace {

constexpr std::uint32_t kLines = 8;  // drawn at most between one look at the space left and the next
// A strip of this size goes to the host: few enough to stay in a core's cache on their way, and the host puts
// them in place while the node draws on.
constexpr std::size_t kFullBytes = std::size_t{512} << 10;
constexpr std::size_t kMaxColorBytes = 8;
constexpr std::size_t kRuns = wire::kMaxStripBytes / sizeof(wire::Run);

// Of one layer's pixels, and what kernels write behind the last.
constexpr std::size_t layer_bytes(std::size_t strip_bytes) { return strip_bytes + simd::kVectorSlack * kMaxColorBytes; }

// Of both layers. Between two runs of a line is a pixel that neither has: small pixels take most as runs of one pixel
// each, large ones as one run.
constexpr std::size_t most_bytes_of_line(std::size_t width, std::size_t pixel_bytes) {
  return 2 * std::max((pixel_bytes + sizeof(wire::Run)) * ((width + 2) / 2), pixel_bytes * width + sizeof(wire::Run));
}

constexpr bool any_line_fits(wire::PixelFormat format) {
  const std::size_t strip = wire::max_strip_bytes(format), counts = wire::kMaxSide * sizeof(std::uint32_t);
  return sizeof(wire::Strip) + 2 * layer_bytes(strip) <= wire::slot_bytes(format) &&
         sizeof(wire::Strip) + most_bytes_of_line(wire::kMaxSide, wire::pixel_bytes(format)) + counts <= strip;
}
static_assert(any_line_fits(wire::PixelFormat::rgb8) && any_line_fits(wire::PixelFormat::half));
static_assert(any_line_fits(wire::with_layers(wire::PixelFormat::half, wire::kAllLayers, wire::kMostSamples)));

// `items` to `at`, which they may overlap; returns what comes behind them.
template <typename T>
std::byte* put(std::span<const T> items, std::byte* at) {
  const bool there = static_cast<const void*>(items.data()) == at;
  if (!there && !items.empty()) std::memmove(at, items.data(), items.size_bytes());
  return at + items.size_bytes();
}

}  // namespace

void StripBuffer::Layer::added(const shading::Shaded& shaded) {
  pixel_count_ += shaded.pixels;
  run_count_ += shaded.runs;
}

StripBuffer::StripBuffer(wire::PixelFormat format, bool watched)
    : pixel_bytes_(wire::pixel_bytes(format)),
      strip_bytes_(wire::max_strip_bytes(format)),
      most_bytes_(strip_bytes_ - (watched ? wire::kMaxSide * sizeof(std::uint32_t) : 0)),
      runs_(2 * kRuns * sizeof(wire::Run)) {}

void StripBuffer::begin(std::span<std::byte> slot, std::size_t width, bool constant) {
  check(slot.size() >= sizeof(wire::Strip) + 2 * layer_bytes(strip_bytes_), "a strip is made in a slot");
  line_bytes_ = most_bytes_of_line(width, pixel_bytes_);
  slot_ = slot.data();
  std::byte* pixels = slot_ + sizeof(wire::Strip);
  auto* runs = reinterpret_cast<wire::Run*>(runs_.bytes().data());
  constant_ = {pixels, pixel_bytes_, runs};
  moving_ = constant ? Layer(pixels + layer_bytes(strip_bytes_), pixel_bytes_, runs + kRuns)
                     : Layer(pixels, pixel_bytes_, runs);
}

std::size_t StripBuffer::bytes() const {
  return sizeof(wire::Strip) + constant_.pixels().size_bytes() + moving_.pixels().size_bytes() +
         constant_.runs().size_bytes() + moving_.runs().size_bytes();
}

std::uint32_t StripBuffer::lines_that_fit() const {
  if (bytes() >= kFullBytes) return 0;
  return static_cast<std::uint32_t>(std::min<std::size_t>(kLines, (most_bytes_ - bytes()) / line_bytes_));
}

std::span<const std::byte> StripBuffer::finish(wire::Strip& header, std::span<const std::uint32_t> edge_boxes) {
  header.constant_runs = static_cast<std::uint32_t>(constant_.runs().size());
  header.moving_runs = static_cast<std::uint32_t>(moving_.runs().size());
  header.pixels = pixel_count();
  std::byte* end = slot_ + sizeof header;
  end = put(moving_.pixels(), put(constant_.pixels(), end));
  end = put(edge_boxes, put(moving_.runs(), put(constant_.runs(), end)));
  const auto size = static_cast<std::size_t>(end - slot_);
  check(size <= strip_bytes_, "a strip has at most max_strip_bytes");
  header.work.pixels += header.pixels;
  header.work.bytes_to_host += size;
  std::memcpy(slot_, &header, sizeof header);
  return {slot_, size};
}

}  // namespace mars::raster
