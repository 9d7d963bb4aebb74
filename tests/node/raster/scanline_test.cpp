// Edge boxes into their lines: edge boxes of several senders against a plain search for each line and part.
#include "node/raster/scanline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <span>
#include <tuple>
#include <vector>

#include "hal/messages/private_memory.h"
#include "tests/node/shape/patches.h"

namespace mars::raster {
namespace {

using geometry::LineRange;
using geometry::Triangle;

constexpr std::uint32_t kLines = 40;
constexpr std::size_t kMostTriangles = 200;  // 30 patches of at most six

// All triangles of a frame as their senders' set-ups leave them.
struct Sent {
  std::vector<Triangle> triangles;
  std::vector<std::vector<UnsortedEdgeBox>> boxes;  // of each sender: moving ones, then stationary ones
  std::vector<Polygons> senders;
  std::vector<std::uint64_t> ebc = std::vector<std::uint64_t>(kLines + 1);
};

// Patches are scattered over the senders; those below `moving_from` stand still.
Sent random_frame(shape::Random& random, std::uint32_t senders, std::uint32_t patches, std::uint32_t moving_from) {
  Sent sent;
  sent.boxes.resize(senders);
  sent.triangles.resize(kMostTriangles);
  std::uint32_t number = 0;
  for (std::uint32_t sender = 0; sender < senders; ++sender) {
    const std::uint32_t first = number;
    auto& boxes = sent.boxes[sender];
    std::size_t stationary = 0;
    for (std::uint32_t patch = sender; patch < patches; patch += senders) {
      for (int triangle = random.whole(0, 6); triangle > 0; --triangle, ++number) {
        const auto line = static_cast<std::uint32_t>(random.whole(0, kLines - 1));
        for (std::uint32_t l = line; l < std::min(line + static_cast<std::uint32_t>(random.whole(1, 5)), kLines); ++l) {
          const auto column = static_cast<std::uint32_t>(random.whole(0, 999));
          boxes.push_back({{number - first, column, static_cast<std::uint32_t>(random.whole(0, 8)),
                            static_cast<std::uint32_t>(random.whole(0, 15))},
                           static_cast<std::uint16_t>(l),
                           patch >= moving_from});
          ++sent.ebc[l + 1];
        }
      }
      if (patch < moving_from) stationary = boxes.size();
    }
    std::reverse(boxes.begin(), boxes.end());
    const std::span all(boxes);
    sent.senders.push_back({sent.triangles.data() + first, all.last(stationary), all.first(all.size() - stationary)});
  }
  for (std::size_t line = 0; line < kLines; ++line) sent.ebc[line + 1] += sent.ebc[line];
  std::shuffle(sent.senders.begin(), sent.senders.end(), std::mt19937(random.bits()));
  return sent;
}

using Box = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t>;

std::multiset<Box> expected_on(const Sent& sent, std::uint32_t line, bool moving) {
  std::multiset<Box> boxes;
  for (const Polygons& sender : sent.senders)
    for (const auto& part : {sender.stationary, sender.moving})
      for (const UnsortedEdgeBox& unsorted : part)
        if (unsorted.line == line && (unsorted.moving != 0) == moving)
          boxes.emplace(static_cast<std::uint32_t>(sender.triangles - sent.triangles.data()) + unsorted.box.triangle,
                        unsorted.box.first, unsorted.box.last(), unsorted.box.sample);
  return boxes;
}

std::multiset<Box> boxes_of(std::span<const EdgeBox> boxes) {
  std::multiset<Box> out;
  for (const EdgeBox& box : boxes) out.emplace(box.triangle, box.first, box.last(), box.sample);
  return out;
}

// Of all lines and of some, from one sender and from many, some of which have nothing.
TEST(LineFiller, PutsEachBoxIntoItsLine) {
  shape::Random random(90);
  messages::PrivateMemory memory(1 << 20);
  Arena arena(memory.bytes());
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
    LineFiller filler(lines, std::span(sent.ebc).subspan(lines.first), sent.triangles.data(), arena);
    for (const Polygons& sender : sent.senders) filler.add(sender);
    const LineBoxes filled = filler.finish();
    bool some_stationary = false;
    for (std::uint32_t line = lines.first; line < lines.last; ++line) {
      ASSERT_EQ(boxes_of(filled.stationary(line)), expected_on(sent, line, false))
          << "trial " << trial << ", line " << line;
      ASSERT_EQ(boxes_of(filled.moving(line)), expected_on(sent, line, true)) << "trial " << trial << ", line " << line;
      some_stationary |= !filled.stationary(line).empty();
    }
    EXPECT_EQ(any_stationary({&filled, 1}, lines), some_stationary);
    boxes += filled.boxes.size();
  }
  EXPECT_GT(boxes, 50000u);
}

}  // namespace
}  // namespace mars::raster
