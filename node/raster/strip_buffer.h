// A strip in the making: header, pixels, runs, as protocol.h lays them out, in a slot. Stationary and moving parts
// come line by line in turn; the strip has all pixels of the first before those of the second. It has at most
// max_strip_bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/messages/private_memory.h"
#include "node/shading/shading.h"
#include "node/wire/protocol.h"

namespace mars::raster {

class StripBuffer {
 public:
  // Pixels and runs of one kind of parts.
  class Layer {
   public:
    Layer() = default;
    Layer(std::byte* pixels, std::size_t pixel_bytes, wire::Run* runs)
        : pixels_(pixels), pixel_bytes_(pixel_bytes), runs_(runs) {}

    // Where kernels write, with kVectorSlack to spare; added() then moves on.
    std::byte* next_pixel() { return pixels_ + pixel_count_ * pixel_bytes_; }
    wire::Run* next_run() { return runs_ + run_count_; }
    void added(const shading::Shaded& shaded);

    std::size_t pixel_count() const { return pixel_count_; }
    std::span<const std::byte> pixels() const { return {pixels_, pixel_count_ * pixel_bytes_}; }
    std::span<const wire::Run> runs() const { return {runs_, run_count_}; }

   private:
    std::byte* pixels_ = nullptr;
    std::size_t pixel_bytes_ = 0;
    wire::Run* runs_ = nullptr;
    std::size_t pixel_count_ = 0;
    std::size_t run_count_ = 0;
  };

  // For pixels of this format; `watched`: with a count of each line. Throws Failure where the machine does not give the
  // memory.
  explicit StripBuffer(wire::PixelFormat format, bool watched = false);

  // Begins an empty one of a picture of `width` in `slot`, which has slot_bytes and is aligned to 64. `constant`:
  // whether stationary parts will come.
  void begin(std::span<std::byte> slot, std::size_t width, bool constant);
  // How many more lines surely fit, whatever they show, a few at most; 0: the strip is full.
  std::uint32_t lines_that_fit() const;

  std::size_t pixel_count() const { return constant_.pixel_count() + moving_.pixel_count(); }
  Layer& constant() { return constant_; }
  Layer& moving() { return moving_; }

  // The whole strip, at the beginning of its slot: `header` with the counts of pixels and runs set, and its work's
  // pixels and bytes to the host grown by what is there. `edge_boxes`: of each of its lines, in watched runs.
  std::span<const std::byte> finish(wire::Strip& header, std::span<const std::uint32_t> edge_boxes = {});

 private:
  std::size_t bytes() const;

  std::size_t pixel_bytes_;
  std::size_t strip_bytes_;     // at most
  std::size_t line_bytes_ = 0;  // that a line takes at most
  std::size_t most_bytes_;      // of all but counts
  std::byte* slot_ = nullptr;
  messages::PrivateMemory runs_;  // until they are put behind the pixels
  Layer constant_;
  Layer moving_;
};

}  // namespace mars::raster
