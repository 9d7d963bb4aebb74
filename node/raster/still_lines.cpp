#include "node/raster/still_lines.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <type_traits>

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
                       const shape::SamplePattern& pattern, std::uint64_t bytes_a_node, std::uint32_t casting,
                       float nothing, bool has_layers)
    : width_(width),
      samples_(static_cast<std::uint32_t>(pattern.count)),
      casting_(casting),
      nothing_(nothing),
      has_groups_(samples_ > 1 || casting > 0),
      has_layers_(has_layers),
      plan_(wire::plan_still_lines(width, height, samples_, bytes_a_node * neighbours.nodes().size(), casting,
                                   has_layers)),
      memory_(neighbours,
              wire::plan_still_lines(width, height, samples_, bytes_a_node * neighbours.most(), casting, has_layers)
                  .bytes(),
              plan_.bytes(), NeighboursMemory::Contents::same),
      marks_(width, height),
      received_tiles_(wire::still_tile_words(width)) {
  static_assert(sizeof(Head) == wire::kStillHeadBytes);
  marks_.mark_all();
}

void StillLines::begin_interval(std::uint32_t keyframe, const geometry::LineRange& lines) {
  keyframe_ = keyframe;
  lines_ = lines;
  all_move_ = false;
}

void StillLines::begin_moving_interval(std::uint32_t keyframe) {
  begin_interval(keyframe, {0, 0});
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

// None without layers.
SurfacePoint* StillLines::surfaces_of(std::uint32_t line) const {
  if (!has_layers_) return nullptr;
  const std::size_t groups = std::size_t{width_} * plan_.groups_per_column;
  return reinterpret_cast<SurfacePoint*>(groups_of(line) + groups * group_bytes());
}

bool StillLines::begin_line(std::uint32_t line, std::uint32_t groups) {
  if (!has_slot(line)) return false;
  if (!has_groups_) return true;
  const bool kept = has_room(line, groups);
  head(line) = {kept ? 1u : 0u, keyframe_, line, groups};
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
  return {ends(line), reinterpret_cast<StillGroup*>(groups_of(line)), surfaces_of(line)};
}

UnsummedStill StillLines::unsummed(std::uint32_t line) {
  return {ends(line), pairs(line), groups_of(line), group_bytes(), surfaces_of(line)};
}

bool StillLines::keeps(std::uint32_t line) const {
  if (!lines_.has(line) || !has_slot(line)) return false;
  const auto is_of = [&](const Head& head) {
    return head.kept == 1 && head.keyframe == keyframe_ && head.line == line;
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
  return columns * wire::still_column_bytes(samples_, casting_) +
         groups * (group_bytes() + wire::surface_bytes(has_layers_));
}

std::size_t StillLines::packed_bytes(std::uint32_t line) const {
  if (!keeps(line)) return 0;
  return wire::still_head_bytes(width_) + count_columns(tiles(line), width_) +
         count_shown(line) * wire::still_packed_bytes(samples_, casting_) + head(line).groups * packed_group_bytes();
}

std::size_t StillLines::most_packed() const {
  if (!has_groups_) return width_ * sizeof(float);
  return wire::still_head_bytes(width_) + width_ * (1 + wire::still_packed_bytes(samples_, casting_)) +
         std::size_t{width_} * samples_ * packed_group_bytes();
}

// Calls visit(first, last) for marked columns with groups.
template <typename Visit>
void StillLines::visit_shown(std::uint32_t line, const Visit& visit) const {
  const std::uint32_t* const end = ends(line);
  const auto shows = [&](std::uint32_t column) { return end[column] > (column == 0 ? 0 : end[column - 1]); };
  visit_columns(tiles(line), width_, [&](std::uint32_t first, std::uint32_t last) {
    for (std::uint32_t begin = first; begin < last;) {
      if (!shows(begin)) {
        ++begin;
        continue;
      }
      std::uint32_t next = begin + 1;
      while (next < last && shows(next)) ++next;
      visit(begin, next);
      begin = next;
    }
  });
}

std::uint32_t StillLines::count_shown(std::uint32_t line) const {
  std::uint32_t count = 0;
  visit_shown(line, [&](std::uint32_t first, std::uint32_t last) { count += last - first; });
  return count;
}

void StillLines::pack(std::uint32_t line, std::byte* to) const {
  std::memcpy(to, slot(line), wire::still_head_bytes(width_));
  to = pack_counts(line, to + wire::still_head_bytes(width_));
  const auto pack_shown = [&](const auto* row) {
    visit_shown(line, [&](std::uint32_t first, std::uint32_t last) {
      std::memcpy(to, row + first, (last - first) * sizeof *row);
      to += (last - first) * sizeof *row;
    });
  };
  for (std::size_t s = 0; s < samples_; ++s) pack_shown(depths(line) + s * width_);
  for (std::size_t l = 0; l < casting_; ++l) pack_shown(pairs(line) + l * width_);
  to = pack_groups(line, to);
  if (has_layers_) std::memcpy(to, surfaces_of(line), head(line).groups * sizeof(SurfacePoint));
}

std::byte* StillLines::pack_counts(std::uint32_t line, std::byte* to) const {
  const std::uint32_t* const end = ends(line);
  visit_columns(tiles(line), width_, [&](std::uint32_t first, std::uint32_t last) {
    std::uint32_t before = first == 0 ? 0 : end[first - 1];
    for (std::uint32_t x = first; x < last; before = end[x++]) *to++ = static_cast<std::byte>(end[x] - before);
  });
  return to;
}

std::byte* StillLines::pack_groups(std::uint32_t line, std::byte* to) const {
  const std::uint32_t count = head(line).groups;
  if (casting_ > 0) return std::copy_n(groups_of(line), count * group_bytes(), to);
  const auto* const groups = reinterpret_cast<const StillGroup*>(groups_of(line));
  for (std::uint32_t k = 0; k < count; ++k, to += sizeof groups->light)
    std::memcpy(to, groups[k].light, sizeof groups->light);
  for (std::uint32_t k = 0; k < count; ++k, to += sizeof(std::uint16_t)) {
    const auto samples = static_cast<std::uint16_t>(groups[k].samples);
    std::memcpy(to, &samples, sizeof samples);
  }
  return to;
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

// None where the line is not as long as its counts of groups say.
std::optional<StillLines::Packed> StillLines::read_packed(std::span<const std::byte> line) {
  const std::size_t columns = count_columns(read_tiles(line), width_);
  std::span<const std::byte> rest = line.subspan(wire::still_head_bytes(width_));
  if (rest.size() < columns) return std::nullopt;
  Packed packed{.counts = rest.first(columns), .depths = {}, .pairs = {}, .groups = {}, .surfaces = {}};
  std::size_t shown = 0, groups = 0;
  for (const std::byte count : packed.counts) {
    if (std::to_integer<std::uint32_t>(count) > samples_) return std::nullopt;
    shown += count != std::byte{0} ? 1 : 0;
    groups += std::to_integer<std::size_t>(count);
  }
  rest = rest.subspan(columns);
  const std::size_t depths = shown * samples_ * sizeof(float), pairs = shown * casting_ * sizeof(wire::StillPairs);
  const std::size_t of_groups = groups * wire::still_packed_group_bytes(casting_);
  if (groups != head_of(line).groups || rest.size() != depths + pairs + groups * packed_group_bytes())
    return std::nullopt;
  packed.depths = rest.first(depths);
  packed.pairs = rest.subspan(depths, pairs);
  packed.groups = rest.subspan(depths + pairs, of_groups);
  packed.surfaces = rest.subspan(depths + pairs + of_groups);
  return packed;
}

bool StillLines::is_packed(std::span<const std::byte> line) {
  if (!has_groups_ || line.size() < wire::still_head_bytes(width_)) return false;
  const Head head = head_of(line);
  if (head.kept != 1 || head.keyframe != keyframe_ || !lines_.has(head.line)) return false;
  const std::uint32_t beyond = wire::still_tiles(width_) % 64;
  if (beyond != 0 && read_tiles(line).back() >> beyond != 0) return false;
  const std::optional<Packed> packed = read_packed(line);
  return packed && are_groups(packed->groups);
}

bool StillLines::are_groups(std::span<const std::byte> groups) const {
  const std::size_t count = groups.size() / wire::still_packed_group_bytes(casting_);
  const auto are_samples = [&]<typename Samples>(Samples samples, std::size_t at, std::size_t stride) {
    for (std::size_t k = 0; k < count; ++k) {
      std::memcpy(&samples, groups.data() + at + k * stride, sizeof samples);
      if (std::uint32_t{samples} >> samples_ != 0) return false;
    }
    return true;
  };
  if (casting_ > 0) return are_samples(std::uint32_t{}, offsetof(wire::UnsummedGroup, samples), group_bytes());
  return are_samples(std::uint16_t{}, count * sizeof(StillGroup::light), sizeof(std::uint16_t));
}

void StillLines::unpack(std::span<const std::byte> line) {
  const Head head = head_of(line);
  if (!begin_line(head.line, head.groups)) return;
  const std::optional<Packed> packed = read_packed(line);
  std::ranges::copy(received_tiles_, tiles(head.line).begin());
  unpack_counts(head.line, packed->counts);
  const std::byte* from = packed->depths.data();
  const auto unpack_shown = [&]<typename Value>(Value* row, const Value& nothing) {
    visit_columns(tiles(head.line), width_,
                  [&](std::uint32_t first, std::uint32_t last) { std::fill(row + first, row + last, nothing); });
    visit_shown(head.line, [&](std::uint32_t first, std::uint32_t last) {
      std::memcpy(row + first, from, (last - first) * sizeof *row);
      from += (last - first) * sizeof *row;
    });
  };
  for (std::size_t s = 0; s < samples_; ++s) unpack_shown(depths(head.line) + s * width_, nothing_);
  for (std::size_t l = 0; l < casting_; ++l) unpack_shown(pairs(head.line) + l * width_, wire::StillPairs{});
  forget_pairs(head.line);
  unpack_groups(head.line, packed->groups);
  if (has_layers_) std::memcpy(surfaces_of(head.line), packed->surfaces.data(), packed->surfaces.size());
}

// Other columns have none.
void StillLines::unpack_counts(std::uint32_t line, std::span<const std::byte> counts) {
  std::uint32_t* const end = ends(line);
  std::uint32_t sum = 0, done = 0;
  const auto fill_to = [&](std::uint32_t column) {
    std::fill(end + done, end + column, sum);
    done = column;
  };
  visit_columns(tiles(line), width_, [&](std::uint32_t first, std::uint32_t last) {
    fill_to(first);
    for (; done < last; ++done, counts = counts.subspan(1))
      end[done] = sum += std::to_integer<std::uint32_t>(counts.front());
  });
  fill_to(width_);
}

void StillLines::unpack_groups(std::uint32_t line, std::span<const std::byte> from) {
  if (casting_ > 0) {
    std::ranges::copy(from, groups_of(line));
    return;
  }
  auto* const groups = reinterpret_cast<StillGroup*>(groups_of(line));
  const std::uint32_t count = head(line).groups;
  const std::byte* const samples = from.data() + count * sizeof groups->light;
  for (std::uint32_t k = 0; k < count; ++k) {
    std::uint16_t of_group;
    std::memcpy(groups[k].light, from.data() + k * sizeof groups->light, sizeof groups->light);
    std::memcpy(&of_group, samples + k * sizeof of_group, sizeof of_group);
    groups[k].samples = of_group;
  }
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
