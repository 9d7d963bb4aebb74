#include "node/strip_buffer.h"

#include <cstring>
#include <new>

#include "hal/failure.h"

namespace mars::node {
namespace {

template <typename T>
std::unique_ptr<T[]> untouched(std::size_t count) {
  std::unique_ptr<T[]> block(new (std::nothrow) T[count]);
  if (!block)
    throw Failure("the machine does not give a node " + std::to_string(count * sizeof(T) >> 20) +
                      " MiB for pixels on their way",
                  "memory", "start fewer nodes a machine or render a smaller picture");
  return block;
}

// A line's runs are apart from each other, so at most every second column begins one.
std::size_t most_runs(std::size_t width, std::size_t height) { return 2 * height * (width / 2 + 1); }

}  // namespace

StripBuffer::StripBuffer(std::size_t width, std::size_t height)
    : message_(untouched<std::byte>(sizeof(Strip) + 2 * width * height * sizeof(std::uint32_t) +
                                    most_runs(width, height) * sizeof(Run))),
      runs_(untouched<Run>(most_runs(width, height))) {}

void StripBuffer::clear() {
  pixel_count_ = 0;
  run_count_ = 0;
}

void StripBuffer::added(const Shaded& shaded) {
  pixel_count_ += shaded.pixels;
  run_count_ += shaded.runs;
}

std::span<const std::byte> StripBuffer::finish(Strip& header) {
  header.pixels = pixel_count_;
  header.moving_runs = static_cast<std::uint32_t>(run_count_) - header.constant_runs;
  const std::size_t runs_at = sizeof header + pixel_count_ * sizeof(std::uint32_t);
  const std::size_t size = runs_at + run_count_ * sizeof(Run);
  header.work.pixels += pixel_count_;
  header.work.bytes_to_host += size;
  std::memcpy(message_.get(), &header, sizeof header);
  if (run_count_ > 0) std::memcpy(message_.get() + runs_at, runs_.get(), run_count_ * sizeof(Run));
  return {message_.get(), size};
}

}  // namespace mars::node
