// Which blocks of the host's buffers show a background that is out of date, as host/render/compositor keeps them: how
// many bytes of background the host restores for each frame that it composes. Only where frames were counted exactly.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "host/experiments/forecast/film_counts.h"
#include "host/render/compositor/block_flags.h"

namespace mars::forecast {

class HostBlocks {
 public:
  // Backgrounds are those of tasks, by number.
  HostBlocks(const FilmCounts& counts, std::uint32_t width, std::uint32_t height, double pixel_bytes);
  HostBlocks(const FilmCounts&&, auto&&...) = delete;

  // A frame of the task begins in the buffer; other numbers than before are new buffers.
  void begin(std::size_t buffer, std::size_t task, std::size_t frame);
  // Bytes of background that its pixels, once all are pasted, have had written: to the buffer and to what is saved.
  double paste(std::size_t buffer, std::size_t task, std::size_t frame);
  // The rest of the buffer shows the background, too.
  double restore(std::size_t buffer);
  // So do lines [first, last), by whoever encodes them.
  void forget_stale(std::size_t buffer, std::uint32_t first, std::uint32_t last);
  // Whether pixels of moving parts are in blocks of the lines.
  bool is_changed(std::size_t buffer, std::uint32_t first, std::uint32_t last) const;

 private:
  struct Buffer {
    std::size_t background;  // the task
    compositor::BlockFlags stale, overwritten;
  };

  void mark(compositor::BlockFlags& flags, std::span<const wire::BlockStretch> blocks) const;
  double refresh(Buffer& buffer, std::span<const wire::BlockStretch> pasted) const;
  double paste_moving(Buffer& buffer, std::span<const wire::BlockStretch> blocks) const;
  double bytes_of(std::uint32_t row, std::uint32_t first, std::uint32_t last) const;
  const KeyframeCounts& keyframe_of(std::size_t task) const;
  bool is_alone(std::size_t task) const;

  const FilmCounts& counts_;
  const std::uint32_t width_, height_;
  const double pixel_bytes_;
  std::vector<Buffer> buffers_;
};

}  // namespace mars::forecast
