#include "host/render/farm/strip_message.h"

#include <algorithm>
#include <bit>

namespace mars::farm {

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

std::optional<StripMessage> StripMessage::read(StripBytes bytes) {
  if (bytes.size < sizeof(wire::Strip)) return std::nullopt;
  StripMessage message(std::move(bytes));
  const wire::Strip& strip = message.header();
  const std::uint64_t rest = message.bytes_.size - sizeof strip;
  const std::uint64_t run_bytes = (std::uint64_t{strip.constant_runs} + strip.moving_runs) * sizeof(wire::Run);
  const bool fits =
      strip.pixels <= rest / sizeof(std::uint32_t) && rest == strip.pixels * sizeof(std::uint32_t) + run_bytes;
  const bool inbetween = strip.kind == wire::FrameKind::inbetween && strip.constant_runs == 0;
  if (!fits || !(inbetween || strip.kind == wire::FrameKind::keyframe)) return std::nullopt;
  std::uint64_t moving_pixels = 0;
  for (const wire::Run& run : message.moving_runs()) moving_pixels += run.count;
  for (const wire::Run& run : message.constant_runs()) message.constant_pixels_ += run.count;
  if (message.constant_pixels_ + moving_pixels != strip.pixels) return std::nullopt;
  return message;
}

std::span<const std::uint32_t> StripMessage::pixels() const {
  return {reinterpret_cast<const std::uint32_t*>(bytes_.data.get() + sizeof(wire::Strip)),
          static_cast<std::size_t>(header().pixels)};
}

std::span<const wire::Run> StripMessage::runs() const {
  const auto at = sizeof(wire::Strip) + header().pixels * sizeof(std::uint32_t);
  return {reinterpret_cast<const wire::Run*>(bytes_.data.get() + at),
          std::size_t{header().constant_runs} + header().moving_runs};
}

}  // namespace mars::farm
