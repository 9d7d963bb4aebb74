#include "node/raster/strip_buffer.h"

#include <cstring>

namespace mars::node {
namespace {

// `items` to `at`, which they may overlap; returns what comes behind them.
template <typename T>
std::byte* put(std::span<const T> items, std::byte* at) {
  const bool there = static_cast<const void*>(items.data()) == at;
  if (!there && !items.empty()) std::memmove(at, items.data(), items.size_bytes());
  return at + items.size_bytes();
}

}  // namespace

void StripBuffer::Layer::added(const Shaded& shaded) {
  pixel_count_ += shaded.pixels;
  run_count_ += shaded.runs;
}

StripBuffer::StripBuffer(std::size_t width)
    : capacity_(kPixels + kLines * width + kVectorSlack),
      message_(sizeof(Strip) + 2 * capacity_ * (sizeof(std::uint32_t) + sizeof(Run))),
      runs_(2 * capacity_ * sizeof(Run)) {}

void StripBuffer::clear(bool constant) {
  auto* pixels = reinterpret_cast<std::uint32_t*>(message_.bytes().data() + sizeof(Strip));
  auto* runs = reinterpret_cast<Run*>(runs_.bytes().data());
  constant_ = {pixels, runs};
  moving_ = constant ? Layer(pixels + capacity_, runs + capacity_) : Layer(pixels, runs);
}

std::span<const std::byte> StripBuffer::finish(Strip& header) {
  header.constant_runs = static_cast<std::uint32_t>(constant_.runs().size());
  header.moving_runs = static_cast<std::uint32_t>(moving_.runs().size());
  header.pixels = constant_.pixels().size() + moving_.pixels().size();
  std::byte* const start = message_.bytes().data();
  std::byte* end = start + sizeof header;
  end = put(moving_.pixels(), put(constant_.pixels(), end));
  end = put(moving_.runs(), put(constant_.runs(), end));
  const auto size = static_cast<std::size_t>(end - start);
  header.work.pixels += header.pixels;
  header.work.bytes_to_host += size;
  std::memcpy(start, &header, sizeof header);
  return {start, size};
}

}  // namespace mars::node
