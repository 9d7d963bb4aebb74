// The memory of what inbetweens need of stationary parts (node/raster/still_lines.h), planned before a node has any of
// it: by nodes, and by the host for its report.
#pragma once

#include <cstddef>
#include <cstdint>

namespace mars::wire {

// A shaded group of a pixel's still samples.
struct StillGroup {
  float light[3];
  std::uint32_t samples;  // one bit each
};

// Where lights cast shadows: a group's light, not summed up. Behind it lie three floats for each casting light, what it
// adds if all of it arrives.
struct UnsummedGroup {
  std::uint32_t samples;
  float fog;  // its share
  float base[3];

  const float* terms() const { return reinterpret_cast<const float*>(this + 1); }
  float* terms() { return reinterpret_cast<float*>(this + 1); }
};

constexpr std::size_t still_group_bytes(std::uint32_t casting) {
  return casting == 0 ? sizeof(StillGroup) : sizeof(UnsummedGroup) + std::size_t{3} * casting * sizeof(float);
}

// What the layers of a picture (pixel_format.h) show of a group: of its shaded sample.
struct SurfacePoint {
  float depth;      // distance along the view axis
  float normal[3];  // a unit vector of the world, turned to the eye; 0: none
  float motion[2];  // pixels; of what stands still 0, but in an interval's first frame
  std::uint32_t segment;
};
// In pictures with layers, beside each group.
constexpr std::size_t surface_bytes(bool has_layers) { return has_layers ? sizeof(SurfacePoint) : 0; }

// Of a pixel, for each casting light: which of its pairs (shadow/pairs.h) matter, and which are blocked.
struct StillPairs {
  std::uint16_t lit;
  std::uint16_t blocked;
};

// What is kept of a line is kept by tiles of this number of columns (raster/still_marks.h).
inline constexpr std::uint32_t kStillTile = 8;
constexpr std::uint32_t still_tiles(std::uint32_t width) { return (width + kStillTile - 1) / kStillTile; }
// One bit each.
constexpr std::size_t still_tile_words(std::uint32_t width) { return (std::size_t{still_tiles(width)} + 63) / 64; }

// Of a column: depths, the number of groups up to it, pairs.
constexpr std::size_t still_column_bytes(std::uint32_t samples, std::uint32_t casting) {
  return samples * sizeof(float) + sizeof(std::uint32_t) + casting * sizeof(StillPairs);
}

// With several samples a pixel, and where lights cast shadows, each line has a head and its tiles, depths, the number
// of groups up to each column, pairs of each casting light, the groups, and of pictures with layers their points.
inline constexpr std::size_t kStillHeadBytes = 16;
constexpr std::size_t whole_cache_lines(std::size_t bytes) { return (bytes + 63) / 64 * 64; }
constexpr std::size_t still_head_bytes(std::uint32_t width) {
  return whole_cache_lines(kStillHeadBytes + still_tile_words(width) * sizeof(std::uint64_t));
}

// Of a line as it travels to another machine: of a column, the number of its groups; of one that has any, depths and
// pairs; of a group, light and samples.
constexpr std::size_t still_packed_bytes(std::uint32_t samples, std::uint32_t casting) {
  return samples * sizeof(float) + casting * sizeof(StillPairs);
}
constexpr std::size_t still_packed_group_bytes(std::uint32_t casting) {
  return casting == 0 ? sizeof(StillGroup::light) + sizeof(std::uint16_t) : still_group_bytes(casting);
}

// Bytes of a message in which such lines, or bands of a background, go round machines (node/group/relay.h), unless a
// line or a band is larger: few, so that messages are on all links at the same time.
inline constexpr std::size_t kRelayPiece = std::size_t{64} << 10;

struct StillPlan {
  std::size_t line_bytes;           // of a line
  std::uint32_t groups_per_column;  // that a line has memory for on average; 0 where there are none
  std::uint32_t lines;              // that fit

  std::size_t bytes() const { return line_bytes * lines; }
};

// For a picture of `width` x `height` within `bytes`. Where several samples or shadows do not fit, first lines have
// memory for fewer groups, then fewer lines are kept. Else all lines are kept, whatever they take. `casting`: lights
// that cast.
StillPlan plan_still_lines(std::uint32_t width, std::uint32_t height, std::uint32_t samples, std::uint64_t bytes,
                           std::uint32_t casting = 0, bool has_layers = false);

}  // namespace mars::wire
