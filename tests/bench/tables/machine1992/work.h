// What the 1992 program's work is counted in. costs.py says what a unit costs.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace mars::machine1992 {

enum class Work : int {
  vertex,    // to eye space with its normal, projected
  polygon,   // its side towards the eye found
  set_up,    // of a triangle that is drawn: its planes
  edge_box,  // made: crossings with a scanline, put into its list
  pass_on,   // an edge box packed, or unpacked and put into its list
  line,      // summed and mapped
  span,      // an edge box drawn: the steps from pixel to pixel
  pixel,     // of an edge box: its depth, compared
  shading,   // of a pixel: its normal, Phong's formula
  clear,     // of a pixel: colour and depth
  look,      // at a pixel: whether something was drawn there
  copy,      // of a pixel
  depth,     // of another node's part of the CZB, that comes
};
inline constexpr std::size_t kWorks = 13;

inline constexpr std::array<const char*, kWorks> kWorkNames = {"vertex", "polygon", "set_up", "edge_box", "pass_on",
                                                               "line",   "span",    "pixel",  "shading",  "clear",
                                                               "look",   "copy",    "depth"};

class WorkCounts {
 public:
  std::uint64_t& operator[](Work work) { return units_[static_cast<std::size_t>(work)]; }
  std::uint64_t operator[](Work work) const { return units_[static_cast<std::size_t>(work)]; }
  WorkCounts& operator+=(const WorkCounts& other);
  bool operator==(const WorkCounts&) const = default;

 private:
  std::array<std::uint64_t, kWorks> units_{};
};

// The calling process has done `work` (messages::charge), which is added to `sum`.
void spend(const WorkCounts& work, WorkCounts& sum);

}  // namespace mars::machine1992
