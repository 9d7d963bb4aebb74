// What an interval's inbetweens need of its stationary parts, on the lines that its moving parts may touch: CZB, the
// depth of each sample; and, where a pixel has several samples, each shaded group of CFB (pixel_groups.h), for the part
// of a pixel that a moving part leaves uncovered. Where lights cast shadows, each group's light before it is summed up,
// and what blocks it, for the shadows of moving parts. Each machine has it once for each group of nodes: the group's
// nodes there write their home lines, and all of them read it.
//
// Home lines are written in a keyframe, after the group's sum of EBC: no node leaves that before all have come to it
// and so have finished the inbetweens of the interval before. Inbetweens read, after StillExchange::complete. A line
// that does not fit is not kept: inbetweens draw its stationary parts again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "node/geometry/line_range.h"
#include "node/raster/neighbours.h"
#include "node/shape/sample_pattern.h"
#include "node/wire/still_plan.h"

namespace mars::raster {

using wire::StillGroup;

// The still groups of a line of pixels: those of column x are groups[x == 0 ? 0 : end[x - 1], end[x]), by their
// shaded samples.
struct StillGroups {
  std::uint32_t* end;
  StillGroup* groups;

  std::span<const StillGroup> of(std::uint32_t column) const {
    const std::uint32_t begin = column == 0 ? 0 : end[column - 1];
    return {groups + begin, end[column] - begin};
  }
};

// The same where lights cast shadows: group k is group(k); pairs of casting light l are pairs[l * width + x].
struct UnsummedStill {
  std::uint32_t* end;
  wire::StillPairs* pairs;
  std::byte* groups;
  std::size_t group_bytes;

  wire::UnsummedGroup& group(std::uint32_t k) const {
    return *reinterpret_cast<wire::UnsummedGroup*>(groups + k * group_bytes);
  }
};

class StillLines {
 public:
  // Of the caller's group: each of its nodes on this machine adds `bytes_a_node`. `casting` lights cast. Pages are used
  // as lines are written. Collective over a machine's nodes. Throws Failure where memory is short.
  StillLines(const Neighbours& neighbours, std::uint32_t width, std::uint32_t height,
             const shape::SamplePattern& pattern, std::uint64_t bytes_a_node, std::uint32_t casting = 0);

  // Lines that will be written in interval `number`; those of others are kept no longer.
  void begin_interval(std::uint32_t number, const geometry::LineRange& lines);
  // Of an interval in which nothing stands still, none are.
  void begin_moving_interval(std::uint32_t number);
  const geometry::LineRange& lines() const { return lines_; }
  // Whether moving parts may be on the line.
  bool has_memory_for(std::uint32_t line) const { return all_move_ || lines_.has(line); }

  // Writing a line: its depths, row by row of the pattern; then its groups, of which there are `count`, unless they
  // are more than fit. Whether the line is kept.
  bool begin_line(std::uint32_t line, std::uint32_t groups);
  std::span<float> depth(std::uint32_t line, std::uint32_t sample);
  StillGroups groups(std::uint32_t line);
  UnsummedStill unsummed(std::uint32_t line);

  bool keeps(std::uint32_t line) const;

  // Whether lines have groups: else they lie one after the other, depths alone.
  bool has_groups() const { return has_groups_; }
  // Of lines without groups.
  std::span<float> depths(const geometry::LineRange& lines);
  // A line with groups as it travels to another machine; nothing where it is not kept.
  std::span<const std::byte> packed(std::uint32_t line) const;
  // Bytes of a line that any machine may send.
  std::size_t most_packed() const;
  // Whether it is such a line, sound to the last group.
  bool is_packed(std::span<const std::byte> line) const;
  // A line that came from there, and is_packed(); not kept where it does not fit here.
  void unpack(std::span<const std::byte> line);

 private:
  // The beginning of a line with groups.
  struct alignas(64) Head {
    std::uint32_t kept;  // 1: all of it is there
    std::uint32_t interval;
    std::uint32_t line;
    std::uint32_t groups;
  };

  bool has_slot(std::uint32_t line) const { return line - lines_.first < plan_.lines; }
  std::byte* slot(std::uint32_t line) const;
  Head& head(std::uint32_t line) const { return *reinterpret_cast<Head*>(slot(line)); }
  static Head head_of(std::span<const std::byte> line);
  std::size_t packed_bytes(std::size_t groups) const;
  std::size_t group_bytes() const { return wire::still_group_bytes(static_cast<std::uint32_t>(casting_)); }
  std::size_t column_bytes() const { return sizeof(std::uint32_t) + casting_ * sizeof(wire::StillPairs); }

  std::size_t width_;
  std::size_t samples_;
  std::size_t casting_;
  bool has_groups_;
  wire::StillPlan plan_;
  NeighboursMemory memory_;
  std::uint32_t interval_ = 0;
  geometry::LineRange lines_{0, 0};
  bool all_move_ = false;
};

}  // namespace mars::raster
