// A strip that came, with its parts in place (node/wire/protocol.h), and the host's memory for what it copies of them.
// Header and runs are the host's own. So are the pixels of a strip that came by message; of others they lie in the
// node's slot, where a node that fails may still change them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "host/render/farm/node_slots.h"
#include "node/wire/protocol.h"

namespace mars::farm {

// Undefined until something is put there.
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
  // The strip that travelled whole in `message`, of pixels in this format; `watched`: as in Load. None unless that is
  // exactly what the header promises.
  static std::optional<StripMessage> read(StripBytes message, wire::PixelFormat format, bool watched = false);
  // The strip whose header came, and whose other parts lie behind it in `slot`. None unless they fit each other.
  static std::optional<StripMessage> read(const wire::Strip& header, std::span<const std::byte> slot,
                                          wire::PixelFormat format, StripStore& store, bool watched = false);

  const wire::Strip& header() const { return header_; }
  NodeSlot slot() const { return {header_.node, header_.slot}; }
  std::span<const wire::Run> runs() const { return runs_; }
  // Of each of its lines, where the run is watched.
  std::span<const std::uint32_t> edge_boxes() const { return edge_boxes_; }
  std::span<const wire::Run> constant_runs() const { return runs_.first(header_.constant_runs); }
  std::span<const wire::Run> moving_runs() const { return runs_.subspan(header_.constant_runs); }
  // Words of pixels.
  std::span<const std::uint32_t> pixels() const { return pixels_; }
  std::span<const std::uint32_t> constant_pixels() const { return pixels_.first(constant_words_); }
  std::span<const std::uint32_t> moving_pixels() const { return pixels_.subspan(constant_words_); }

  // The host's memory that it took, to be used for another.
  StripBytes release() { return std::move(bytes_); }

 private:
  StripMessage(const wire::Strip& header, StripBytes bytes, std::span<const std::byte> runs,
               std::span<const std::byte> pixels);

  bool count_pixels(wire::PixelFormat format);

  wire::Strip header_;
  StripBytes bytes_;
  std::span<const wire::Run> runs_;
  std::span<const std::uint32_t> edge_boxes_;  // behind them
  std::span<const std::uint32_t> pixels_;
  std::size_t constant_words_ = 0;
};

}  // namespace mars::farm
