#include "tests/node/raster/set_ups.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <span>

#include "node/simd/instruction_set.h"

namespace mars::raster {
namespace {

// Memory that begins and ends between bytes of a known value.
class GuardedMemory {
 public:
  explicit GuardedMemory(std::size_t bytes) : bytes_(bytes), cells_(new Cell[(bytes + 2 * kGuard) / sizeof(Cell) + 1]) {
    std::fill_n(data(), kGuard, kUntouched);
    std::fill_n(data() + kGuard + bytes, kGuard, kUntouched);
  }

  std::span<std::byte> inside() { return {data() + kGuard, bytes_}; }
  bool intact() {
    const auto untouched = [](std::byte b) { return b == kUntouched; };
    return std::all_of(data(), data() + kGuard, untouched) &&
           std::all_of(data() + kGuard + bytes_, data() + kGuard + bytes_ + kGuard, untouched);
  }

 private:
  static constexpr std::size_t kGuard = 4096;
  static constexpr std::byte kUntouched{0x5a};
  struct alignas(64) Cell {
    std::byte bytes[64];
  };
  std::byte* data() { return cells_[0].bytes; }

  std::size_t bytes_;
  std::unique_ptr<Cell[]> cells_;
};

}  // namespace

Made set_up(simd::InstructionSet set, const Picture& picture, const shape::Surface& surface,
            const PatchIdentity& identity, Way way, const std::vector<std::uint8_t>& wanted_lines, std::size_t bytes) {
  GuardedMemory memory(bytes);
  Made made;
  made.line_loads.resize(static_cast<std::size_t>(picture.height));
  const std::vector<std::uint8_t> all(made.line_loads.size(), 1);
  auto* const first = reinterpret_cast<geometry::Triangle*>(memory.inside().data());
  const shape::SamplePattern& pattern = shape::sample_pattern(picture.samples);
  SetUps out(memory.inside(), first, pattern, made.line_loads);
  out.want(wanted_lines.empty() ? all : wanted_lines);
  SetUp set_up(set, picture.projection, picture.width, picture.height, pattern, picture.casting);
  if (way == Way::at_a_time)
    set_up.add(surface, identity, out);
  else
    set_up.add_plainly(surface, identity, out);
  EXPECT_TRUE(memory.intact()) << simd::name_of(set);
  made.triangles.assign(out.triangles().begin(), out.triangles().end());
  made.boxes.assign(out.boxes().rbegin(), out.boxes().rend());
  made.touching = out.touching;
  made.edge_boxes = out.edge_boxes;
  made.all_stored = out.all_stored();
  return made;
}

}  // namespace mars::raster
