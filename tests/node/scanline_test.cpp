// Edge boxes into their lines: crossings of several senders against a plain sort by line, part and polygon number.
#include "node/scanline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>
#include <vector>

#include "tests/node/patches.h"

namespace mars::test {
namespace {

using node::Crossing;
using node::EdgeBox;
using node::LineRange;
using node::Triangle;

constexpr std::uint32_t kLines = 40;

// All triangles of a frame as their senders' set-ups leave them, and what was sent.
struct Sent {
  std::vector<Triangle> triangles;
  std::vector<std::vector<Crossing>> crossings;  // of each sender: moving ones, then stationary ones, the last first
  std::vector<node::Polygons::Source> sources;
  std::vector<std::uint64_t> ebc = std::vector<std::uint64_t>(kLines + 1);
};

// Patches are scattered over the senders; those below `moving_from` stand still.
Sent random_frame(Random& random, std::uint32_t senders, std::uint32_t patches, std::uint32_t moving_from) {
  Sent sent;
  sent.crossings.resize(senders);
  for (std::uint32_t sender = 0; sender < senders; ++sender) {
    const auto first = static_cast<std::uint32_t>(sent.triangles.size());
    auto& crossings = sent.crossings[sender];
    std::size_t stationary = 0;
    for (std::uint32_t patch = sender; patch < patches; patch += senders) {
      for (int triangle = random.whole(0, 6); triangle > 0; --triangle) {
        const auto line = static_cast<std::uint32_t>(random.whole(0, kLines - 1));
        for (std::uint32_t l = line; l < std::min(line + static_cast<std::uint32_t>(random.whole(1, 5)), kLines); ++l) {
          const auto column = static_cast<std::uint16_t>(random.whole(0, 999));
          crossings.push_back({{static_cast<std::uint32_t>(sent.triangles.size()) - first, column,
                                static_cast<std::uint16_t>(column + 1)},
                               static_cast<std::uint16_t>(l),
                               patch >= moving_from});
          ++sent.ebc[l + 1];
        }
        sent.triangles.emplace_back().patch = patch;
      }
      if (patch < moving_from) stationary = crossings.size();
    }
    std::reverse(crossings.begin(), crossings.end());
    const std::span all(crossings);
    sent.sources.push_back({first, all.last(stationary), all.first(all.size() - stationary)});
  }
  for (std::size_t line = 0; line < kLines; ++line) sent.ebc[line + 1] += sent.ebc[line];
  std::shuffle(sent.sources.begin(), sent.sources.end(), std::mt19937(random.bits()));
  return sent;
}

std::vector<EdgeBox> expected_on(const Sent& sent, std::uint32_t line, bool moving) {
  std::vector<EdgeBox> boxes;
  for (const auto& source : sent.sources)
    for (const auto& part : {source.stationary, source.moving})
      for (const Crossing& c : part)
        if (c.line == line && (c.moving != 0) == moving)
          boxes.push_back({source.first + c.box.triangle, c.box.first, c.box.last});
  std::sort(boxes.begin(), boxes.end(), [&](const EdgeBox& a, const EdgeBox& b) {
    return std::tuple(sent.triangles[a.triangle].patch, a.triangle) <
           std::tuple(sent.triangles[b.triangle].patch, b.triangle);
  });
  return boxes;
}

bool same(std::span<const EdgeBox> a, const std::vector<EdgeBox>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const EdgeBox& x, const EdgeBox& y) {
    return std::tie(x.triangle, x.first, x.last) == std::tie(y.triangle, y.first, y.last);
  });
}

// Of all lines and of some, from one sender and from many, some of whom have nothing.
TEST(FillLines, PutsBoxesInTheOrderOfPolygons) {
  Random random(90);
  node::Arena arena(1 << 20);
  std::size_t boxes = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const auto patches = static_cast<std::uint32_t>(random.whole(0, 30));
    const Sent sent = random_frame(random, static_cast<std::uint32_t>(random.whole(1, 9)), patches,
                                   static_cast<std::uint32_t>(random.whole(0, 30)));
    LineRange lines{static_cast<std::uint32_t>(random.whole(0, kLines)), kLines};
    if (trial % 3 == 0) lines = {0, kLines};
    if (trial % 3 == 1)
      lines.last = static_cast<std::uint32_t>(random.whole(static_cast<std::int32_t>(lines.first), kLines));
    arena.clear();
    const node::LineBoxes filled = node::fill_lines({sent.triangles.data(), sent.sources}, lines, sent.ebc, arena);
    for (std::uint32_t line = lines.first; line < lines.last; ++line) {
      ASSERT_TRUE(same(filled.stationary(line), expected_on(sent, line, false)))
          << "trial " << trial << ", line " << line;
      ASSERT_TRUE(same(filled.moving(line), expected_on(sent, line, true))) << "trial " << trial << ", line " << line;
    }
    boxes += filled.boxes.size();
  }
  EXPECT_GT(boxes, 50000u);
}

}  // namespace
}  // namespace mars::test
