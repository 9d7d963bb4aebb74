#include "host/farm/strip_message.h"

#include "hal/failure.h"

namespace mars::host {

StripMessage::StripMessage(std::vector<std::byte> bytes) : bytes_(std::move(bytes)) {
  const auto require = [](bool holds) {
    if (!holds) throw Failure("a strip of pixels is not what its header says", "node protocol", "please report it");
  };
  require(bytes_.size() >= sizeof(node::Strip));
  const node::Strip& strip = header();
  const std::uint64_t rest = bytes_.size() - sizeof strip;
  const std::uint64_t run_bytes = (std::uint64_t{strip.constant_runs} + strip.moving_runs) * sizeof(node::Run);
  require(strip.pixels <= rest / sizeof(std::uint32_t) && rest == strip.pixels * sizeof(std::uint32_t) + run_bytes);
  std::uint64_t counted = 0;
  for (const node::Run& run : moving_runs()) counted += run.count;
  for (const node::Run& run : constant_runs()) constant_pixels_ += run.count;
  require(constant_pixels_ + counted == strip.pixels);
}

std::span<const std::uint32_t> StripMessage::pixels() const {
  return {reinterpret_cast<const std::uint32_t*>(bytes_.data() + sizeof(node::Strip)),
          static_cast<std::size_t>(header().pixels)};
}

std::span<const node::Run> StripMessage::runs() const {
  const auto at = sizeof(node::Strip) + header().pixels * sizeof(std::uint32_t);
  return {reinterpret_cast<const node::Run*>(bytes_.data() + at),
          std::size_t{header().constant_runs} + header().moving_runs};
}

}  // namespace mars::host
