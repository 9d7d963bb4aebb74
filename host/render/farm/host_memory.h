// The host's memory for one rendering, shared out before it begins: buffers of the sinks, saved backgrounds, and strips
// that nodes have on the way, which their credits bound. The film and what a file format needs while it is written come
// on top.
#pragma once

#include <cstdint>

#include "node/wire/film_parts.h"
#include "node/wire/pixel_format.h"

namespace mars::farm {

struct HostMemory {
  wire::PixelFormat format = wire::PixelFormat::rgb8;
  std::uint64_t budget = 0;       // bytes, as it was given
  std::uint64_t frame_bytes = 0;  // of one picture
  std::uint32_t frames = 0;       // buffers of the sinks, at least 2; 1 where nodes write
  std::uint32_t backgrounds = 0;  // saved ones: one a group, and those of earlier intervals that buffers still show
  std::uint32_t nodes = 0;        // that send strips
  std::int32_t credits = 0;       // strips that each may have on the way, 1..wire::kMaxCredits

  // Bytes of all strips on the way, at most; of all parts. Above the budget only where the least of each part is.
  std::uint64_t strip_bytes() const;
  std::uint64_t most_bytes() const;
};

// Backgrounds come first, then credits, then buffers: two more than the sinks have threads, but no more than fit 1 GiB
// or an eighth of the budget.
HostMemory share_host_memory(std::uint64_t budget, const wire::FilmSettings& film, wire::PixelFormat format,
                             std::uint32_t nodes, std::uint32_t groups, std::uint32_t sink_threads);

// The part of the shared memory that the host uses where nodes write all files: no strips come, and there is only the
// buffer with which the sinks begin.
HostMemory where_nodes_write(HostMemory shared);

}  // namespace mars::farm
