// A strip as it arrived, with its parts in place (node/wire/protocol.h), and the memory that strips arrive in.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "node/wire/protocol.h"

namespace mars::farm {

// The bytes of one message; undefined until it is received.
struct StripBytes {
  std::unique_ptr<std::byte[]> data;
  std::size_t size = 0;
  std::size_t capacity = 0;  // at least size
};

// Memory of strips that were pasted, for those to come: once warm, nothing is allocated.
class StripStore {
 public:
  StripBytes take(std::size_t size);
  void give_back(StripBytes bytes) { spare_.push_back(std::move(bytes)); }

 private:
  std::vector<StripBytes> spare_;  // last given back first: what is still in a cache
};

class StripMessage {
 public:
  // None unless the bytes are exactly what the strip's header promises.
  static std::optional<StripMessage> read(StripBytes bytes);

  const wire::Strip& header() const { return *reinterpret_cast<const wire::Strip*>(bytes_.data.get()); }
  std::span<const wire::Run> runs() const;
  std::span<const wire::Run> constant_runs() const { return runs().first(header().constant_runs); }
  std::span<const wire::Run> moving_runs() const { return runs().subspan(header().constant_runs); }
  std::span<const std::uint32_t> pixels() const;
  std::span<const std::uint32_t> constant_pixels() const { return pixels().first(constant_pixels_); }
  std::span<const std::uint32_t> moving_pixels() const { return pixels().subspan(constant_pixels_); }

  // The bytes, to be used for another message.
  StripBytes release() { return std::move(bytes_); }

 private:
  explicit StripMessage(StripBytes bytes) : bytes_(std::move(bytes)) {}

  StripBytes bytes_;
  std::uint64_t constant_pixels_ = 0;
};

}  // namespace mars::farm
