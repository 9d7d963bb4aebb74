// One strip on its way to the host: header, pixels, runs, as protocol.h lays them out, built in place.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "node/kernels.h"
#include "node/protocol.h"

namespace mars::node {

class StripBuffer {
 public:
  // Room for every pixel of a picture twice (stationary and moving). Pages are used as they are touched.
  // Throws Failure where the machine does not give it.
  StripBuffer(std::size_t width, std::size_t height);

  void clear();

  // Where kernels write; added() then moves on.
  std::uint32_t* next_pixel() { return pixels() + pixel_count_; }
  Run* next_run() { return runs_.get() + run_count_; }
  void added(const Shaded& shaded);

  std::uint64_t pixel_count() const { return pixel_count_; }
  std::uint64_t run_count() const { return run_count_; }

  // The message, valid until clear(): `header` (the first constant_runs runs belong to CFB) with the counts of
  // pixels and runs set, and its work's pixels and bytes to the host grown by what is sent.
  std::span<const std::byte> finish(Strip& header);

 private:
  std::uint32_t* pixels() { return reinterpret_cast<std::uint32_t*>(message_.get() + sizeof(Strip)); }

  std::unique_ptr<std::byte[]> message_;
  std::unique_ptr<Run[]> runs_;
  std::uint64_t pixel_count_ = 0;
  std::uint64_t run_count_ = 0;
};

}  // namespace mars::node
