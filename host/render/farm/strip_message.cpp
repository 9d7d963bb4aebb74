#include "host/render/farm/strip_message.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <numeric>

namespace mars::farm {
namespace {

// Where they begin, in bytes from the header's first.
struct Parts {
  std::size_t pixels;
  std::size_t runs;
  std::size_t end;
};

// Of the counts behind the runs; none where the lines make no sense.
std::optional<std::size_t> counted_bytes(const wire::Strip& header, bool watched) {
  if (!watched) return 0;
  if (header.first_line > header.last_line || header.last_line > wire::kMaxSide) return std::nullopt;
  return (header.last_line - header.first_line) * sizeof(std::uint32_t);
}

// None where the header makes no sense: what it promises is of no kind, or more than a strip has.
std::optional<Parts> parts_of(const wire::Strip& header, wire::PixelFormat format, bool watched) {
  const bool inbetween = header.kind == wire::FrameKind::inbetween && header.constant_runs == 0;
  if (!inbetween && header.kind != wire::FrameKind::keyframe) return std::nullopt;
  const std::uint64_t runs = std::uint64_t{header.constant_runs} + header.moving_runs;
  const auto counts = counted_bytes(header, watched);
  if (!counts || header.pixels > wire::max_strip_bytes(format) || runs > wire::max_strip_bytes(format))
    return std::nullopt;
  Parts parts{sizeof header, 0, 0};
  parts.runs = parts.pixels + static_cast<std::size_t>(header.pixels) * wire::pixel_bytes(format);
  parts.end = parts.runs + static_cast<std::size_t>(runs) * sizeof(wire::Run) + *counts;
  if (parts.end > wire::max_strip_bytes(format)) return std::nullopt;
  return parts;
}

std::span<const std::byte> pixels_in(std::span<const std::byte> strip, const Parts& parts) {
  return strip.subspan(parts.pixels, parts.runs - parts.pixels);
}

}  // namespace

StripBytes StripStore::take(std::size_t size) {
  const auto fits =
      std::find_if(spare_.rbegin(), spare_.rend(), [&](const StripBytes& s) { return s.capacity >= size; });
  // Where none fits, one that is too small makes way: there are no more than were in use at once.
  StripBytes bytes;
  if (!spare_.empty()) {
    if (fits != spare_.rend()) std::swap(*fits, spare_.back());
    bytes = std::move(spare_.back());
    spare_.pop_back();
  }
  if (bytes.capacity < size) {
    // Of which only what is used takes memory.
    const std::size_t capacity = std::max(size, std::min(std::bit_ceil(size), wire::kMaxStripBytes));
    bytes.data.reset();
    bytes = {std::make_unique_for_overwrite<std::byte[]>(capacity), 0, capacity};
  }
  bytes.size = size;
  return bytes;
}

StripMessage::StripMessage(const wire::Strip& header, StripBytes bytes, std::span<const std::byte> runs,
                           std::span<const std::byte> pixels)
    : header_(header),
      bytes_(std::move(bytes)),
      runs_(reinterpret_cast<const wire::Run*>(runs.data()), std::size_t{header.constant_runs} + header.moving_runs),
      edge_boxes_(reinterpret_cast<const std::uint32_t*>(runs.data() + runs_.size_bytes()),
                  (runs.size() - runs_.size_bytes()) / sizeof(std::uint32_t)),
      pixels_(reinterpret_cast<const std::uint32_t*>(pixels.data()), pixels.size() / sizeof(std::uint32_t)) {}

std::optional<StripMessage> StripMessage::read(StripBytes message, wire::PixelFormat format, bool watched) {
  if (message.size < sizeof(wire::Strip)) return std::nullopt;
  wire::Strip header;
  std::memcpy(&header, message.data.get(), sizeof header);
  const auto parts = parts_of(header, format, watched);
  if (header.by_message != 1 || !parts || parts->end != message.size) return std::nullopt;
  const std::span<const std::byte> whole(message.data.get(), message.size);
  StripMessage strip(header, std::move(message), whole.subspan(parts->runs), pixels_in(whole, *parts));
  if (!strip.count_pixels(format)) return std::nullopt;
  return strip;
}

std::optional<StripMessage> StripMessage::read(const wire::Strip& header, std::span<const std::byte> slot,
                                               wire::PixelFormat format, StripStore& store, bool watched) {
  const auto parts = parts_of(header, format, watched);
  if (header.by_message != 0 || !parts || parts->end > slot.size()) return std::nullopt;
  StripBytes runs = store.take(parts->end - parts->runs);
  const std::span<const std::byte> own(runs.data.get(), runs.size);
  std::ranges::copy(slot.subspan(parts->runs, runs.size), runs.data.get());
  StripMessage strip(header, std::move(runs), own, pixels_in(slot, *parts));
  if (!strip.count_pixels(format)) return std::nullopt;
  return strip;
}

// Whether the runs have as many as the header says.
bool StripMessage::count_pixels(wire::PixelFormat format) {
  const auto count_words = [format](std::span<const wire::Run> runs) {
    return std::accumulate(runs.begin(), runs.end(), std::size_t{0},
                           [](std::size_t sum, const wire::Run& run) { return sum + run.count; }) *
           wire::pixel_words(format);
  };
  constant_words_ = count_words(constant_runs());
  return constant_words_ + count_words(moving_runs()) == pixels_.size();
}

}  // namespace mars::farm
