// Walls: the parts of a rendering's time. The gain of a wall is by how much the rendering is shorter if the wall takes
// no time. Forecasts compute the time without some walls by a rehearsal (host/experiments/forecast/explain.h), reports
// from recorded times (host/render/report/replay.h). Both then find here which wall binds, and which binds next.
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

namespace mars::walls {

enum class Wall {
  compute,    // work of the nodes: dicing, visibility, shading
  imbalance,  // what the busiest node of a keyframe does more than the mean
  sum,        // messages of the group's sum of edge boxes
  exchange,   // of triangles
  still,      // of lines for inbetweens
  bands,      // of encoded bands, where nodes write files
  host,       // the host's loop, and messages to and from it
  encoder,    // what makes files of frames: a host's sinks, or nodes that compose frames and write them
  storage,    // takes the files
  frame,      // what one frame's path is longer than its share: some nodes draw while others have nothing left
};

struct WallWords {
  std::string_view name;
  std::string_view about;
};

inline constexpr std::array<WallWords, 10> kWallWords{{
    {"compute", "work of the nodes, evenly divided"},
    {"imbalance", "what the busiest node of a keyframe does beyond the mean"},
    {"sum", "sums of edge boxes over groups"},
    {"exchange", "triangles from node to node"},
    {"still lines", "still lines from node to node"},
    {"bands", "bands of keyframes from node to node"},
    {"host", "the host's loop and its messages"},
    {"encoder", "encoding of files"},
    {"storage", "the storage of files"},
    {"one frame", "nodes draw while others have nothing left"},
}};

constexpr std::string_view name_of(Wall wall) { return kWallWords[static_cast<std::size_t>(wall)].name; }

class Walls {
 public:
  Walls() = default;
  Walls(std::initializer_list<Wall> walls) {
    for (const Wall wall : walls) add(wall);
  }
  static Walls all() { return Walls(Bits().set()); }

  bool has(Wall wall) const { return bits_[static_cast<std::size_t>(wall)]; }
  Walls& add(Wall wall) { return bits_.set(static_cast<std::size_t>(wall)), *this; }
  Walls with(Walls others) const { return Walls(bits_ | others.bits_); }
  Walls without(Walls others) const { return Walls(bits_ & ~others.bits_); }
  std::vector<Wall> list() const;
  unsigned long number() const { return bits_.to_ulong(); }

 private:
  using Bits = std::bitset<kWallWords.size()>;
  explicit Walls(Bits bits) : bits_(bits) {}

  Bits bits_;
};

// Seconds of a rendering in which these walls take no time.
using SecondsWithout = std::function<double(Walls)>;
// The same of several, each by its place.
using AllSecondsWithout = std::function<std::vector<double>(const std::vector<Walls>&)>;

// A part of a rendering's time: where no wall's gain is more, several bind together, and the one that is longest alone
// is named.
inline constexpr double kNoGain = 0.02;

struct FoundWall {
  Wall wall;
  double alone;    // seconds, of a rendering without all other walls
  double without;  // seconds, of the rendering without this one
  double gain;     // seconds, by which the wall that binds is chosen; of `compute`, where work is even
};

struct Explanation {
  double seconds = 0;
  std::vector<FoundWall> walls;  // that take time: the one that binds first, then by gain
  std::optional<Wall> next;      // binds where the first takes no time
  double without_next = 0;       // seconds, of the rendering without the first and that one

  const FoundWall* binding() const { return walls.empty() ? nullptr : &walls.front(); }
};

// `there`: the others take no time at all.
Explanation explain(const AllSecondsWithout& seconds, Walls there);
Explanation explain(const SecondsWithout& seconds, Walls there);

}  // namespace mars::walls
