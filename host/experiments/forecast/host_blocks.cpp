#include "host/experiments/forecast/host_blocks.h"

#include <algorithm>

namespace mars::forecast {
namespace {

constexpr std::uint32_t kBlock = wire::kCountedBlock;
constexpr std::size_t kNone = static_cast<std::size_t>(-1);

}  // namespace

HostBlocks::HostBlocks(const FilmCounts& counts, std::uint32_t width, std::uint32_t height, double pixel_bytes)
    : counts_(counts), width_(width), height_(height), pixel_bytes_(pixel_bytes) {}

const KeyframeCounts& HostBlocks::keyframe_of(std::size_t task) const {
  return counts_.keyframes[counts_.tasks[task].keyframe];
}

// Then it has no background: all its pixels are pasted as those of moving parts.
bool HostBlocks::is_alone(std::size_t task) const { return counts_.tasks[task].inbetweens.empty(); }

// A keyframe begins before there is a background.
void HostBlocks::begin(std::size_t number, std::size_t task, std::size_t frame) {
  while (buffers_.size() <= number)
    buffers_.push_back(
        {kNone, compositor::BlockFlags(width_, height_, kBlock), compositor::BlockFlags(width_, height_, kBlock)});
  Buffer& buffer = buffers_[number];
  const std::size_t background = frame == 0 ? kNone : task;
  buffer.stale |= buffer.overwritten;
  if (buffer.background != background) {
    if (buffer.background != kNone) mark(buffer.stale, keyframe_of(buffer.background).constant_blocks);
    if (background != kNone) mark(buffer.stale, keyframe_of(background).constant_blocks);
  }
  buffer.overwritten.clear();
  buffer.background = background;
}

double HostBlocks::paste(std::size_t number, std::size_t task, std::size_t frame) {
  Buffer& buffer = buffers_[number];
  if (frame > 0) return paste_moving(buffer, counts_.tasks[task].inbetweens[frame - 1].blocks);
  const KeyframeCounts& keyframe = keyframe_of(task);
  if (is_alone(task))
    return paste_moving(buffer, keyframe.constant_blocks) + paste_moving(buffer, keyframe.moving_blocks);
  double bytes = refresh(buffer, keyframe.constant_blocks);
  for (const wire::BlockStretch& saved : keyframe.constant_blocks)
    bytes += bytes_of(saved.row, saved.first, saved.last);
  buffer.background = task;
  return bytes + paste_moving(buffer, keyframe.moving_blocks);
}

double HostBlocks::paste_moving(Buffer& buffer, std::span<const wire::BlockStretch> blocks) const {
  const double bytes = refresh(buffer, blocks);
  mark(buffer.overwritten, blocks);
  return bytes;
}

double HostBlocks::restore(std::size_t number) {
  compositor::BlockFlags& stale = buffers_[number].stale;
  double bytes = 0;
  for (std::uint32_t row = 0; row < stale.rows(); ++row)
    stale.for_stretches(row, [&](std::uint32_t first, std::uint32_t last) { bytes += bytes_of(row, first, last); });
  stale.clear();
  return bytes;
}

void HostBlocks::forget_stale(std::size_t number, std::uint32_t first, std::uint32_t last) {
  for (std::uint32_t row = first / kBlock; row * kBlock < last; ++row) buffers_[number].stale.clear_row(row);
}

bool HostBlocks::is_changed(std::size_t number, std::uint32_t first, std::uint32_t last) const {
  for (std::uint32_t row = first / kBlock; row * kBlock < last; ++row)
    if (buffers_[number].overwritten.any(row)) return true;
  return false;
}

void HostBlocks::mark(compositor::BlockFlags& flags, std::span<const wire::BlockStretch> blocks) const {
  for (const wire::BlockStretch& stretch : blocks)
    flags.set_pixels(stretch.row * kBlock, stretch.first * kBlock,
                     std::min<std::uint32_t>(width_, stretch.last * kBlock) - stretch.first * kBlock);
}

// Of the rows that pixels are pasted into, stale blocks, but for those that the pixels fill.
double HostBlocks::refresh(Buffer& buffer, std::span<const wire::BlockStretch> pasted) const {
  double bytes = 0;
  for (std::size_t i = 0; i < pasted.size();) {
    const std::uint32_t row = pasted[i].row;
    compositor::BlockFlags& stale = buffer.stale;
    if (stale.any(row))
      stale.for_stretches(row, [&](std::uint32_t first, std::uint32_t last) { bytes += bytes_of(row, first, last); });
    for (; i < pasted.size() && pasted[i].row == row; ++i)
      for (std::uint32_t column = pasted[i].first; pasted[i].filled == 1 && column < pasted[i].last; ++column)
        bytes -= stale.at(column, row) ? bytes_of(row, column, column + 1) : 0;
    stale.clear_row(row);
  }
  return bytes;
}

// Columns [first, last) of blocks.
double HostBlocks::bytes_of(std::uint32_t row, std::uint32_t first, std::uint32_t last) const {
  const std::uint32_t columns = std::min(width_, last * kBlock) - first * kBlock;
  const std::uint32_t lines = std::min(height_, (row + 1) * kBlock) - row * kBlock;
  return pixel_bytes_ * columns * lines;
}

}  // namespace mars::forecast
