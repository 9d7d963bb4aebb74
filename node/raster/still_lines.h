// What an interval's inbetweens need of its stationary parts, on the columns of lines that its moving parts or their
// shadows may change: CZB, the depth of each sample; and, where a pixel has several samples, each shaded group of CFB
// (pixel_groups.h), for the part of a pixel that a moving part leaves uncovered. Where lights cast shadows, each
// group's light before it is summed up, and what blocks it, for the shadows of moving parts. Each machine has it once
// for each group of nodes: the group's nodes there write their home lines, and all of them read it.
//
// Which columns these are, all nodes know before a keyframe where only moving parts count; where shadows do, a line's
// home finds it, and the line says it. What lies in its memory on other columns has no meaning, but that they have
// neither groups nor pairs.
//
// Home lines are written in a keyframe, after the group's sum of EBC: no node leaves that before all have come to it
// and so have finished the inbetweens of the interval before. Inbetweens read, after StillExchange::complete. A line
// that does not fit is not kept: inbetweens draw its stationary parts again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "node/geometry/line_range.h"
#include "node/raster/neighbours.h"
#include "node/raster/still_marks.h"
#include "node/shape/sample_pattern.h"
#include "node/wire/still_plan.h"

namespace mars::raster {

using wire::StillGroup;
using wire::SurfacePoint;

// The still groups of a line of pixels: those of column x are groups[x == 0 ? 0 : end[x - 1], end[x]), by their
// shaded samples.
struct StillGroups {
  std::uint32_t* end;
  StillGroup* groups;
  // Of pictures with layers: the groups' points, and what their light is if nothing blocks any (none: the same).
  SurfacePoint* surfaces = nullptr;
  const StillGroup* unshadowed = nullptr;

  std::uint32_t begin(std::uint32_t column) const { return column == 0 ? 0 : end[column - 1]; }
  std::span<const StillGroup> of(std::uint32_t column) const {
    return {groups + begin(column), end[column] - begin(column)};
  }
};

// The same where lights cast shadows: group k is group(k); pairs of casting light l are pairs[l * width + x].
struct UnsummedStill {
  std::uint32_t* end;
  wire::StillPairs* pairs;
  std::byte* groups;
  std::size_t group_bytes;
  SurfacePoint* surfaces = nullptr;  // of pictures with layers

  wire::UnsummedGroup& group(std::uint32_t k) const {
    return *reinterpret_cast<wire::UnsummedGroup*>(groups + k * group_bytes);
  }
};

class StillLines {
 public:
  // Of the caller's group: each of its nodes on this machine adds `bytes_a_node`. `casting` lights cast. Pages are used
  // as lines are written. `nothing`: as in shape::Projection. Collective over a machine's nodes. Throws Failure where
  // memory is short.
  StillLines(const Neighbours& neighbours, std::uint32_t width, std::uint32_t height,
             const shape::SamplePattern& pattern, std::uint64_t bytes_a_node, std::uint32_t casting = 0,
             float nothing = 0, bool has_layers = false);

  // Lines that will be written in the interval of this keyframe; those of other keyframes are kept no longer. An
  // interval that is cut has several keyframes.
  void begin_interval(std::uint32_t keyframe, const geometry::LineRange& lines);
  // Of an interval in which nothing stands still, none are.
  void begin_moving_interval(std::uint32_t keyframe);
  const geometry::LineRange& lines() const { return lines_; }
  // Whether moving parts may be on the line.
  bool has_memory_for(std::uint32_t line) const { return all_move_ || lines_.has(line); }

  // The columns that lines are written with: all, until that is changed.
  StillMarks& marks() { return marks_; }

  // Whether a line with that many groups is kept for sure.
  bool has_room(std::uint32_t line, std::uint32_t groups) const {
    return lines_.has(line) && has_slot(line) && (!has_groups_ || groups <= width_ * plan_.groups_per_column);
  }
  // Writing a line: the depths of marked columns, row by row of the pattern; then their groups, of which there are
  // `groups`, unless they are more than fit. Whether the line is kept.
  bool begin_line(std::uint32_t line, std::uint32_t groups);
  std::span<float> depth(std::uint32_t line, std::uint32_t sample);
  // Copies a row of depths to it; says how many.
  std::uint32_t keep_depths(std::uint32_t line, std::uint32_t sample, const float* from);
  StillGroups groups(std::uint32_t line);
  UnsummedStill unsummed(std::uint32_t line);
  // Copies a line's pairs to it.
  void keep_pairs(std::uint32_t line, const wire::StillPairs* from);

  // Of a line about, if a column has one group; known before the keyframe, and the same on all nodes.
  std::uint64_t foreseen_bytes(std::uint32_t line) const;
  // What that many columns with that many groups take.
  std::size_t kept_bytes(std::size_t columns, std::size_t groups) const;

  bool keeps(std::uint32_t line) const;
  // The columns that a kept line has.
  MarkedTiles columns(std::uint32_t line) const { return has_groups_ ? tiles(line) : marks_.on(line); }

  // Copies depths that it has of the columns.
  void take_depths(std::uint32_t line, std::uint32_t sample, const geometry::ColumnRange& of, float* to) const;

  // Whether lines have groups: else they are depths alone, on columns that all nodes know.
  bool has_groups() const { return has_groups_; }
  // Lines without groups as they travel to another machine: their bytes, and from and to memory.
  std::size_t depth_bytes(const geometry::LineRange& lines) const;
  void pack_depths(const geometry::LineRange& lines, std::byte* to) const;
  void unpack_depths(const geometry::LineRange& lines, const std::byte* from);
  // A line with groups as it travels to another machine; nothing where it is not kept.
  std::size_t packed_bytes(std::uint32_t line) const;
  void pack(std::uint32_t line, std::byte* to) const;
  // Bytes of a line that any machine may send.
  std::size_t most_packed() const;
  // Whether it is such a line, sound to the last group.
  bool is_packed(std::span<const std::byte> line);
  // A line that came from there, and is_packed(); not kept where it does not fit here.
  void unpack(std::span<const std::byte> line);

 private:
  // The beginning of a line with groups. Its tiles follow.
  struct Head {
    std::uint32_t kept;  // 1: all of it is there
    std::uint32_t keyframe;
    std::uint32_t line;
    std::uint32_t groups;
  };

  bool has_slot(std::uint32_t line) const { return line - lines_.first < plan_.lines; }
  // What lies in a line's memory, in this order.
  std::byte* slot(std::uint32_t line) const;
  Head& head(std::uint32_t line) const { return *reinterpret_cast<Head*>(slot(line)); }
  std::span<std::uint64_t> tiles(std::uint32_t line) const;
  float* depths(std::uint32_t line) const;
  std::uint32_t* ends(std::uint32_t line) const;
  wire::StillPairs* pairs(std::uint32_t line) const;
  std::byte* groups_of(std::uint32_t line) const;
  SurfacePoint* surfaces_of(std::uint32_t line) const;

  // Parts of a line as it travels: its head and tiles, and of marked columns in this order ...
  struct Packed {
    std::span<const std::byte> counts;  // a byte each, of groups
    std::span<const std::byte> depths;  // sample by sample, of columns with groups
    std::span<const std::byte> pairs;   // light by light, of the same columns
    std::span<const std::byte> groups;
    std::span<const std::byte> surfaces;
  };

  static Head head_of(std::span<const std::byte> line);
  MarkedTiles read_tiles(std::span<const std::byte> line);
  std::optional<Packed> read_packed(std::span<const std::byte> line);
  bool are_groups(std::span<const std::byte> groups) const;
  template <typename Visit>
  void visit_shown(std::uint32_t line, const Visit& visit) const;
  std::uint32_t count_shown(std::uint32_t line) const;
  std::byte* pack_counts(std::uint32_t line, std::byte* to) const;
  std::byte* pack_groups(std::uint32_t line, std::byte* to) const;
  void unpack_counts(std::uint32_t line, std::span<const std::byte> counts);
  void unpack_groups(std::uint32_t line, std::span<const std::byte> from);
  void forget_pairs(std::uint32_t line);
  std::size_t group_bytes() const { return wire::still_group_bytes(casting_); }
  std::size_t packed_group_bytes() const {
    return wire::still_packed_group_bytes(casting_) + wire::surface_bytes(has_layers_);
  }

  std::uint32_t width_;
  std::uint32_t samples_;
  std::uint32_t casting_;
  float nothing_;
  bool has_groups_;
  bool has_layers_;
  wire::StillPlan plan_;
  NeighboursMemory memory_;
  StillMarks marks_;
  std::vector<std::uint64_t> received_tiles_;  // of a line in hand
  std::uint32_t keyframe_ = 0;
  geometry::LineRange lines_{0, 0};
  bool all_move_ = false;
};

}  // namespace mars::raster
