#include "host/render/farm/strip_message.h"

#include <algorithm>
#include <bit>

#include "hal/failure/failure.h"

namespace mars::host {

StripBytes StripStore::take(std::size_t size) {
  const auto fits = std::find_if(spare_.rbegin(), spare_.rend(), [&](const StripBytes& s) { return s.room >= size; });
  // Where none fits, one that is too small makes way: there are no more than were in use at once.
  StripBytes bytes;
  if (!spare_.empty()) {
    if (fits != spare_.rend()) std::swap(*fits, spare_.back());
    bytes = std::move(spare_.back());
    spare_.pop_back();
  }
  if (bytes.room < size) {
    const std::size_t room = std::bit_ceil(size);  // of which only what is used takes memory
    bytes.data.reset();
    bytes = {std::make_unique_for_overwrite<std::byte[]>(room), 0, room};
  }
  bytes.size = size;
  return bytes;
}

StripMessage::StripMessage(StripBytes bytes) : bytes_(std::move(bytes)) {
  const auto require = [](bool holds) {
    if (!holds) throw Failure("a strip of pixels is not what its header says", "node protocol", "please report it");
  };
  require(bytes_.size >= sizeof(node::Strip));
  const node::Strip& strip = header();
  const std::uint64_t rest = bytes_.size - sizeof strip;
  const std::uint64_t run_bytes = (std::uint64_t{strip.constant_runs} + strip.moving_runs) * sizeof(node::Run);
  require(strip.pixels <= rest / sizeof(std::uint32_t) && rest == strip.pixels * sizeof(std::uint32_t) + run_bytes);
  require(strip.kind == node::FrameKind::keyframe || strip.constant_runs == 0);
  std::uint64_t counted = 0;
  for (const node::Run& run : moving_runs()) counted += run.count;
  for (const node::Run& run : constant_runs()) constant_pixels_ += run.count;
  require(constant_pixels_ + counted == strip.pixels);
}

std::span<const std::uint32_t> StripMessage::pixels() const {
  return {reinterpret_cast<const std::uint32_t*>(bytes_.data.get() + sizeof(node::Strip)),
          static_cast<std::size_t>(header().pixels)};
}

std::span<const node::Run> StripMessage::runs() const {
  const auto at = sizeof(node::Strip) + header().pixels * sizeof(std::uint32_t);
  return {reinterpret_cast<const node::Run*>(bytes_.data.get() + at),
          std::size_t{header().constant_runs} + header().moving_runs};
}

}  // namespace mars::host
