// The edge boxes of each scanline in linked lists (thesis figure 4.8), those of stationary and of moving parts apart.
#pragma once

#include <cstdint>
#include <vector>

#include "node/geometry/triangle.h"
#include "tests/bench/tables/machine1992/messages.h"

namespace mars::machine1992 {

class EdgeLists {
 public:
  static constexpr std::uint32_t kEnd = 0xffffffffu;

  struct EdgeBox {
    std::uint32_t next;   // number of the list's next, or kEnd
    std::uint16_t first;  // columns [first, last)
    std::uint16_t last;
  };

  explicit EdgeLists(std::uint32_t lines) : stationary_(lines, kEnd), moving_(lines, kEnd) {}

  void clear();
  // Of triangles of one patch, the first before the others.
  void add(const SentBox& box);

  std::uint32_t first_of(std::uint32_t line, bool moving) const { return moving ? moving_[line] : stationary_[line]; }
  const EdgeBox& box(std::uint32_t number) const { return boxes_[number]; }
  // By the numbers of their edge boxes.
  const geometry::Triangle* triangles() const { return triangles_.data(); }
  std::uint32_t size() const { return static_cast<std::uint32_t>(boxes_.size()); }

 private:
  std::vector<geometry::Triangle> triangles_;
  std::vector<EdgeBox> boxes_;
  std::vector<std::uint32_t> stationary_;  // the first of each line
  std::vector<std::uint32_t> moving_;
};

}  // namespace mars::machine1992
