#include "node/raster/still_lines.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "hal/failure/failure.h"

namespace mars::raster {
namespace {

// Copies `count` elements of every row of columns.
template <typename T>
std::byte* pack_columns(const T* from, MarkedTiles tiles, std::uint32_t width, std::byte* to) {
  visit_columns(tiles, width, [&](std::uint32_t first, std::uint32_t last) {
    std::memcpy(to, from + first, (last - first) * sizeof(T));
    to += (last - first) * sizeof(T);
  });
  return to;
}

template <typename T>
const std::byte* unpack_columns(const std::byte* from, MarkedTiles tiles, std::uint32_t width, T* to) {
  visit_columns(tiles, width, [&](std::uint32_t first, std::uint32_t last) {
    std::memcpy(to + first, from, (last - first) * sizeof(T));
    from += (last - first) * sizeof(T);
  });
  return from;
}

}  // namespace

StillLines::StillLines(const Neighbours& neighbours, std::uint32_t width, std::uint32_t height,
                       const shape::SamplePattern& pattern, std::uint64_t bytes_a_node, std::uint32_t casting)
    : width_(width),
      samples_(static_cast<std::uint32_t>(pattern.count)),
      casting_(casting),
      has_groups_(samples_ > 1 || casting > 0),
      plan_(wire::plan_still_lines(width, height, samples_, bytes_a_node * neighbours.nodes().size(), casting)),
      memory_(neighbours,
              wire::plan_still_lines(width, height, samples_, bytes_a_node * neighbours.most(), casting).bytes(),
              plan_.bytes(), NeighboursMemory::Contents::same),
      marks_(width, height),
      received_tiles_(wire::still_tile_words(width)) {
  static_assert(sizeof(Head) == wire::kStillHeadBytes);
  marks_.mark_all();
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

std::span<std::uint64_t> StillLines::tiles(std::uint32_t line) const {
  return {reinterpret_cast<std::uint64_t*>(slot(line) + sizeof(Head)), wire::still_tile_words(width_)};
}

float* StillLines::depths(std::uint32_t line) const {
  return reinterpret_cast<float*>(slot(line) + (has_groups_ ? wire::still_head_bytes(width_) : 0));
}

std::uint32_t* StillLines::ends(std::uint32_t line) const {
  return reinterpret_cast<std::uint32_t*>(depths(line) + std::size_t{width_} * samples_);
}

wire::StillPairs* StillLines::pairs(std::uint32_t line) const {
  return reinterpret_cast<wire::StillPairs*>(ends(line) + width_);
}

std::byte* StillLines::groups_of(std::uint32_t line) const {
  return reinterpret_cast<std::byte*>(pairs(line) + std::size_t{width_} * casting_);
}

bool StillLines::begin_line(std::uint32_t line, std::uint32_t groups) {
  if (!has_slot(line)) return false;
  if (!has_groups_) return true;
  const bool kept = has_room(line, groups);
  head(line) = {kept ? 1u : 0u, interval_, line, groups};
  std::ranges::copy(marks_.on(line), tiles(line).begin());
  return kept;
}

std::span<float> StillLines::depth(std::uint32_t line, std::uint32_t sample) {
  return {depths(line) + std::size_t{width_} * sample, width_};
}

std::uint32_t StillLines::keep_depths(std::uint32_t line, std::uint32_t sample, const float* from) {
  float* const to = depths(line) + std::size_t{width_} * sample;
  std::uint32_t count = 0;
  visit_columns(marks_.on(line), width_, [&](std::uint32_t first, std::uint32_t last) {
    std::copy(from + first, from + last, to + first);
    count += last - first;
  });
  return count;
}

void StillLines::take_depths(std::uint32_t line, std::uint32_t sample, const geometry::ColumnRange& of,
                             float* to) const {
  const float* const from = depths(line) + std::size_t{width_} * sample;
  visit_columns(columns(line), width_, [&](std::uint32_t first, std::uint32_t last) {
    first = std::max(first, of.first), last = std::min(last, of.last);
    if (first < last) std::copy(from + first, from + last, to + first);
  });
}

StillGroups StillLines::groups(std::uint32_t line) {
  return {ends(line), reinterpret_cast<StillGroup*>(groups_of(line))};
}

UnsummedStill StillLines::unsummed(std::uint32_t line) {
  return {ends(line), pairs(line), groups_of(line), group_bytes()};
}

bool StillLines::keeps(std::uint32_t line) const {
  if (!lines_.has(line) || !has_slot(line)) return false;
  const auto is_of = [&](const Head& head) {
    return head.kept == 1 && head.interval == interval_ && head.line == line;
  };
  return !has_groups_ || is_of(head(line));
}

std::size_t StillLines::depth_bytes(const geometry::LineRange& lines) const {
  std::size_t columns = 0;
  for (std::uint32_t line = lines.first; line < lines.last; ++line) columns += count_columns(marks_.on(line), width_);
  return columns * sizeof(float);
}

void StillLines::pack_depths(const geometry::LineRange& lines, std::byte* to) const {
  for (std::uint32_t line = lines.first; line < lines.last; ++line)
    to = pack_columns(depths(line), marks_.on(line), width_, to);
}

void StillLines::unpack_depths(const geometry::LineRange& lines, const std::byte* from) {
  for (std::uint32_t line = lines.first; line < lines.last; ++line)
    from = unpack_columns(from, marks_.on(line), width_, depths(line));
}

std::uint64_t StillLines::foreseen_bytes(std::uint32_t line) const {
  if (!lines_.has(line)) return 0;
  const std::uint32_t columns = count_columns(marks_.on(line), width_);
  return kept_bytes(columns, columns);
}

std::size_t StillLines::kept_bytes(std::size_t columns, std::size_t groups) const {
  if (!has_groups_) return columns * sizeof(float);
  return columns * wire::still_column_bytes(samples_, casting_) + groups * group_bytes();
}

std::size_t StillLines::packed_bytes(std::uint32_t line) const {
  if (!keeps(line)) return 0;
  return wire::still_head_bytes(width_) + kept_bytes(count_columns(tiles(line), width_), head(line).groups);
}

std::size_t StillLines::most_packed() const {
  return wire::still_head_bytes(width_) + kept_bytes(width_, std::size_t{width_} * samples_);
}

void StillLines::pack(std::uint32_t line, std::byte* to) const {
  const MarkedTiles marked = tiles(line);
  std::memcpy(to, slot(line), wire::still_head_bytes(width_));
  to += wire::still_head_bytes(width_);
  for (std::size_t s = 0; s < samples_; ++s) to = pack_columns(depths(line) + s * width_, marked, width_, to);
  to = pack_columns(ends(line), marked, width_, to);
  for (std::size_t l = 0; l < casting_; ++l) to = pack_columns(pairs(line) + l * width_, marked, width_, to);
  std::memcpy(to, groups_of(line), head(line).groups * group_bytes());
}

// A message's bytes are not aligned as a line's own.
StillLines::Head StillLines::head_of(std::span<const std::byte> line) {
  Head head;
  std::memcpy(&head, line.data(), sizeof head);
  return head;
}

MarkedTiles StillLines::read_tiles(std::span<const std::byte> line) {
  std::memcpy(received_tiles_.data(), line.data() + sizeof(Head), received_tiles_.size() * sizeof(std::uint64_t));
  return received_tiles_;
}

bool StillLines::is_packed(std::span<const std::byte> line) {
  if (!has_groups_ || line.size() < wire::still_head_bytes(width_)) return false;
  const Head head = head_of(line);
  if (head.kept != 1 || head.interval != interval_ || !lines_.has(head.line)) return false;
  const MarkedTiles marked = read_tiles(line);
  const std::uint32_t beyond = wire::still_tiles(width_) % 64;
  if (beyond != 0 && marked.back() >> beyond != 0) return false;
  const std::size_t columns = count_columns(marked, width_);
  const std::size_t head_bytes = wire::still_head_bytes(width_);
  if (line.size() != head_bytes + kept_bytes(columns, head.groups)) return false;
  const std::size_t ends_at = head_bytes + columns * samples_ * sizeof(float);
  const auto groups = line.last(head.groups * group_bytes());
  return are_ends(line.subspan(ends_at, columns * sizeof(std::uint32_t)), head.groups) && are_groups(groups);
}

bool StillLines::are_ends(std::span<const std::byte> ends, std::uint32_t groups) {
  std::uint32_t before = 0;
  for (std::size_t at = 0; at < ends.size(); at += sizeof before) {
    std::uint32_t end;
    std::memcpy(&end, ends.data() + at, sizeof end);
    if (end < before) return false;
    before = end;
  }
  return before == groups;
}

bool StillLines::are_groups(std::span<const std::byte> groups) const {
  const std::size_t samples_at = casting_ > 0 ? offsetof(wire::UnsummedGroup, samples) : offsetof(StillGroup, samples);
  for (std::size_t at = 0; at < groups.size(); at += group_bytes()) {
    std::uint32_t samples;
    std::memcpy(&samples, groups.data() + at + samples_at, sizeof samples);
    if (samples >> samples_ != 0) return false;
  }
  return true;
}

void StillLines::unpack(std::span<const std::byte> line) {
  const Head packed = head_of(line);
  if (!begin_line(packed.line, packed.groups)) return;
  const MarkedTiles marked = read_tiles(line);
  std::ranges::copy(marked, tiles(packed.line).begin());
  const std::byte* from = line.data() + wire::still_head_bytes(width_);
  for (std::size_t s = 0; s < samples_; ++s)
    from = unpack_columns(from, marked, width_, depths(packed.line) + s * width_);
  from = unpack_columns(from, marked, width_, ends(packed.line));
  fill_ends(packed.line);
  for (std::size_t l = 0; l < casting_; ++l)
    from = unpack_columns(from, marked, width_, pairs(packed.line) + l * width_);
  forget_pairs(packed.line);
  std::memcpy(groups_of(packed.line), from, packed.groups * group_bytes());
}

// Other columns have no groups.
void StillLines::fill_ends(std::uint32_t line) {
  std::uint32_t* const end = ends(line);
  visit_other_columns(tiles(line), width_, [&](std::uint32_t first, std::uint32_t last) {
    std::fill(end + first, end + last, first == 0 ? 0 : end[first - 1]);
  });
}

void StillLines::keep_pairs(std::uint32_t line, const wire::StillPairs* from) {
  for (std::size_t l = 0; l < casting_; ++l)
    visit_columns(tiles(line), width_, [&](std::uint32_t first, std::uint32_t last) {
      std::copy_n(from + l * width_ + first, last - first, pairs(line) + l * width_ + first);
    });
  forget_pairs(line);
}

// Other columns have none.
void StillLines::forget_pairs(std::uint32_t line) {
  for (std::size_t l = 0; l < casting_; ++l)
    visit_other_columns(tiles(line), width_, [&](std::uint32_t first, std::uint32_t last) {
      std::fill_n(pairs(line) + l * width_ + first, last - first, wire::StillPairs{0, 0});
    });
}

}  // namespace mars::raster
