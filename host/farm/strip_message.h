// A strip as it arrived, with its parts in place (node/protocol.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "node/protocol.h"

namespace mars::host {

class StripMessage {
 public:
  // Throws Failure unless the bytes are exactly what the strip's header promises.
  explicit StripMessage(std::vector<std::byte> bytes);

  const node::Strip& header() const { return *reinterpret_cast<const node::Strip*>(bytes_.data()); }
  std::span<const node::Run> constant_runs() const { return runs().first(header().constant_runs); }
  std::span<const node::Run> moving_runs() const { return runs().subspan(header().constant_runs); }
  std::span<const std::uint32_t> constant_pixels() const { return pixels().first(constant_pixels_); }
  std::span<const std::uint32_t> moving_pixels() const { return pixels().subspan(constant_pixels_); }

  // The bytes, to be used for another message.
  std::vector<std::byte> release() { return std::move(bytes_); }

 private:
  std::span<const std::uint32_t> pixels() const;
  std::span<const node::Run> runs() const;

  std::vector<std::byte> bytes_;
  std::uint64_t constant_pixels_ = 0;
};

}  // namespace mars::host
