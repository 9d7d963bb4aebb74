#include "node/raster/still_lines.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "hal/failure/failure.h"

namespace mars::raster {
namespace {

std::size_t depth_bytes(std::size_t width, std::size_t samples) { return width * samples * sizeof(float); }

}  // namespace

StillLines::StillLines(const Neighbours& neighbours, std::uint32_t width, std::uint32_t height,
                       const shape::SamplePattern& pattern, std::uint64_t bytes_a_node, std::uint32_t casting)
    : width_(width),
      samples_(static_cast<std::size_t>(pattern.count)),
      casting_(casting),
      has_groups_(samples_ > 1 || casting > 0),
      plan_(wire::plan_still_lines(width, height, static_cast<std::uint32_t>(pattern.count),
                                   bytes_a_node * neighbours.nodes().size(), casting)),
      memory_(neighbours,
              wire::plan_still_lines(width, height, static_cast<std::uint32_t>(pattern.count),
                                     bytes_a_node * neighbours.most(), casting)
                  .bytes(),
              plan_.bytes(), NeighboursMemory::Contents::same) {
  static_assert(sizeof(Head) == wire::kStillHeadBytes);
}

void StillLines::begin_interval(std::uint32_t number, const geometry::LineRange& lines) {
  interval_ = number;
  lines_ = lines;
  all_move_ = false;
}

void StillLines::begin_moving_interval(std::uint32_t number) {
  begin_interval(number, {0, 0});
  all_move_ = true;
}

std::byte* StillLines::slot(std::uint32_t line) const {
  return memory_.bytes().data() + (line - lines_.first) * plan_.line_bytes;
}

bool StillLines::begin_line(std::uint32_t line, std::uint32_t groups) {
  if (!has_slot(line)) return false;
  if (!has_groups_) return true;
  const bool kept = groups <= width_ * plan_.groups_per_column;
  head(line) = {kept ? 1u : 0u, interval_, line, groups};
  return kept;
}

std::span<float> StillLines::depth(std::uint32_t line, std::uint32_t sample) {
  const std::size_t begin = !has_groups_ ? 0 : wire::kStillHeadBytes + depth_bytes(width_, sample);
  return {reinterpret_cast<float*>(slot(line) + begin), width_};
}

StillGroups StillLines::groups(std::uint32_t line) {
  std::byte* const end = slot(line) + wire::kStillHeadBytes + depth_bytes(width_, samples_);
  return {reinterpret_cast<std::uint32_t*>(end), reinterpret_cast<StillGroup*>(end + width_ * sizeof(std::uint32_t))};
}

UnsummedStill StillLines::unsummed(std::uint32_t line) {
  std::byte* const end = slot(line) + wire::kStillHeadBytes + depth_bytes(width_, samples_);
  std::byte* const pairs = end + width_ * sizeof(std::uint32_t);
  return {reinterpret_cast<std::uint32_t*>(end), reinterpret_cast<wire::StillPairs*>(pairs),
          pairs + width_ * casting_ * sizeof(wire::StillPairs), group_bytes()};
}

bool StillLines::keeps(std::uint32_t line) const {
  if (!lines_.has(line) || !has_slot(line)) return false;
  const auto is_of = [&](const Head& head) {
    return head.kept == 1 && head.interval == interval_ && head.line == line;
  };
  return !has_groups_ || is_of(head(line));
}

std::span<float> StillLines::depths(const geometry::LineRange& lines) {
  check(!has_groups_, "lines lie one after the other");
  return {depth(lines.first, 0).data(), lines.count() * width_};
}

std::size_t StillLines::packed_bytes(std::size_t groups) const {
  return wire::kStillHeadBytes + depth_bytes(width_, samples_) + width_ * column_bytes() + groups * group_bytes();
}

std::size_t StillLines::most_packed() const { return packed_bytes(width_ * samples_); }

std::span<const std::byte> StillLines::packed(std::uint32_t line) const {
  if (!keeps(line)) return {};
  return {slot(line), packed_bytes(head(line).groups)};
}

// A message's bytes are not aligned as a line's own.
StillLines::Head StillLines::head_of(std::span<const std::byte> line) {
  Head head;
  std::memcpy(&head, line.data(), sizeof head);
  return head;
}

bool StillLines::is_packed(std::span<const std::byte> line) const {
  if (!has_groups_ || line.size() < sizeof(Head)) return false;
  const Head head = head_of(line);
  if (head.kept != 1 || head.interval != interval_ || !lines_.has(head.line) ||
      line.size() != packed_bytes(head.groups))
    return false;
  const auto* const end =
      reinterpret_cast<const std::uint32_t*>(line.data() + sizeof head + depth_bytes(width_, samples_));
  const std::span columns(end, width_);
  const std::byte* const groups = line.data() + line.size() - head.groups * group_bytes();
  const std::size_t samples_at = casting_ > 0 ? offsetof(wire::UnsummedGroup, samples) : offsetof(StillGroup, samples);
  for (std::size_t k = 0; k < head.groups; ++k) {
    std::uint32_t samples;
    std::memcpy(&samples, groups + k * group_bytes() + samples_at, sizeof samples);
    if (samples >> samples_ != 0) return false;
  }
  return std::ranges::is_sorted(columns) && columns.back() == head.groups;
}

void StillLines::unpack(std::span<const std::byte> line) {
  const Head head = head_of(line);
  if (!begin_line(head.line, head.groups)) return;
  std::memcpy(slot(head.line), line.data(), line.size());
}

}  // namespace mars::raster
