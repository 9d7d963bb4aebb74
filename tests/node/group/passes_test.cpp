// The number of passes of a frame: bounds on memory against an arena that is used as a frame uses it, and one number
// for all nodes of a group.
#include "node/group/passes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <mutex>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "hal/failure/failure.h"
#include "hal/messages/private_memory.h"
#include "hal/nx/nx_messages.h"
#include "node/geometry/triangle.h"
#include "node/group/group_sums.h"
#include "node/group/mapping.h"
#include "node/raster/arena.h"
#include "node/raster/edge_box.h"
#include "node/wire/protocol.h"
#include "tests/hal/counting_backend.h"
#include "tests/node/shape/patches.h"

namespace mars::group {
namespace {

using geometry::LineRange;

// A frame of a group, as each of its nodes knows it.
class Frame {
 public:
  // `counts`: of each node, edge boxes a line. `travels`: nodes cannot read each other's memory.
  explicit Frame(std::vector<std::vector<std::uint32_t>> counts, std::vector<std::uint64_t> triangles,
                 bool travels = true)
      : group_{0, static_cast<int>(counts.size())},
        travels_(travels && counts.size() > 1),
        counts_(std::move(counts)),
        loads_(counts_.size()),
        triangles_(std::move(triangles)),
        homes_(counts_.size()),
        ebc_(counts_[0].size() + 1) {
    for (std::size_t line = 0; line + 1 < ebc_.size(); ++line) {
      ebc_[line + 1] = ebc_[line];
      for (const auto& own : counts_) ebc_[line + 1] += own[line];
    }
    map_greedy(ebc_, homes_);
    for (std::size_t n = 0; n < counts_.size(); ++n) {
      for (const std::uint32_t boxes : counts_[n]) loads_[n].emplace_back(boxes, 0);
    }
  }

  std::size_t nodes() const { return counts_.size(); }
  std::uint32_t lines() const { return static_cast<std::uint32_t>(counts_[0].size()); }
  MadeCounts made(std::size_t n) const {
    return {triangles_[n], std::accumulate(counts_[n].begin(), counts_[n].end(), std::uint64_t{0})};
  }
  FrameLoad load(std::size_t n) const { return {group_, ebc_, homes_, 0, loads_[n], triangles_[n], travels_}; }
  const std::vector<LineRange>& homes() const { return homes_; }
  bool travels() const { return travels_; }
  std::uint64_t boxes(std::size_t n, const LineRange& lines) const {
    const auto& own = counts_[n];
    return std::accumulate(own.begin() + lines.first, own.begin() + lines.last, std::uint64_t{0});
  }

 private:
  collectives::Group group_;
  bool travels_;
  std::vector<std::vector<std::uint32_t>> counts_;
  std::vector<std::vector<raster::LineLoad>> loads_;
  std::vector<std::uint64_t> triangles_;
  std::vector<LineRange> homes_;
  std::vector<std::uint64_t> ebc_;
};

Frame random_frame(shape::Random& random, int nodes, int lines) {
  std::vector<std::vector<std::uint32_t>> counts(static_cast<std::size_t>(nodes));
  std::vector<std::uint64_t> triangles;
  for (auto& own : counts) {
    const int most = random.whole(0, 3) ? random.whole(0, 200) : 0;
    for (int line = 0; line < lines; ++line) own.push_back(static_cast<std::uint32_t>(random.whole(0, most)));
    const auto boxes = std::accumulate(own.begin(), own.end(), 0u);
    triangles.push_back(static_cast<std::uint64_t>(random.whole(0, static_cast<std::int32_t>(boxes))));
  }
  return Frame(std::move(counts), std::move(triangles), random.whole(0, 1) == 1);
}

// Takes what a pass takes of a node's arena at most; check()s that it fits.
void use(raster::Arena& arena, const Frame& frame, std::size_t n, const Pass& pass) {
  arena.clear();
  std::vector<LineRange> parts;
  for (const LineRange& home : frame.homes()) parts.push_back(part_of(home, pass));
  std::uint64_t own = 0, drawn = 0;
  for (const LineRange& part : parts) own += frame.boxes(n, part);
  for (std::size_t other = 0; other < frame.nodes(); ++other) drawn += frame.boxes(other, parts[n]);
  arena.take_ends(std::min(own, frame.made(n).triangles) * sizeof(geometry::Triangle),
                  own * sizeof(raster::UnsortedEdgeBox));
  const auto take_filler = [&](std::uint64_t boxes, std::uint64_t lines) {
    arena.take<raster::EdgeBox>(boxes);
    for (int array = 0; array < 3; ++array) arena.take<std::uint64_t>(lines);
  };
  take_filler(own, frame.lines());
  if (!frame.travels()) return;
  const auto take_message = [&](std::uint64_t boxes) {
    if (boxes == 0) return;
    const std::uint64_t before_triangles =
        sizeof(wire::TriangleHead) + 63 + boxes * sizeof(raster::UnsortedEdgeBox) + 63;
    arena.take<std::byte>(before_triangles + boxes * sizeof(geometry::Triangle));
  };
  for (std::size_t other = 0; other < frame.nodes(); ++other)
    if (other != n) take_message(frame.boxes(n, parts[other]));
  arena.take<std::uint64_t>(parts[n].count() + 1);
  take_filler(drawn - frame.boxes(n, parts[n]), parts[n].count());
  for (std::size_t other = 0; other < frame.nodes(); ++other)
    if (other != n) take_message(frame.boxes(other, parts[n]));
}

TEST(Passes, PartsTileAHomeAndLieWithinCoarserParts) {
  shape::Random random(120);
  for (int trial = 0; trial < 300; ++trial) {
    const auto first = static_cast<std::uint32_t>(random.whole(0, 1000));
    const LineRange home{first, first + static_cast<std::uint32_t>(random.whole(0, 1000))};
    const std::uint32_t count = 1u << random.whole(0, 8);
    std::uint32_t next = home.first;
    for (std::uint32_t number = 0; number < count; ++number) {
      const LineRange part = part_of(home, {number, count});
      EXPECT_EQ(part.first, next);
      next = part.last;
      EXPECT_EQ(part_of(home, {2 * number, 2 * count}).first, part.first);
      EXPECT_EQ(part_of(home, {2 * number + 1, 2 * count}).last, part.last);
    }
    EXPECT_EQ(next, home.last);
  }
}

TEST(Passes, EveryLineIsWantedInOnePass) {
  const std::vector<LineRange> homes{{0, 7}, {7, 7}, {7, 20}};
  std::vector<int> times(20);
  for (std::uint32_t number = 0; number < 4; ++number) {
    std::vector<std::uint8_t> wanted(20, 7);
    mark_lines(homes, {number, 4}, wanted);
    for (std::size_t line = 0; line < wanted.size(); ++line) times[line] += wanted[line];
  }
  EXPECT_EQ(times, std::vector<int>(20, 1));
}

TEST(Passes, FramesFitTheMemoryPlanned) {
  shape::Random random(121);
  for (int trial = 0; trial < 200; ++trial) {
    const Frame frame = random_frame(random, random.whole(1, 6), random.whole(1, 60));
    for (std::size_t n = 0; n < frame.nodes(); ++n)
      for (const std::uint32_t count : {1u, 2u, 8u}) {
        const messages::PrivateMemory memory(memory_for(frame.load(n), static_cast<int>(n), count));
        raster::Arena arena(memory.bytes());
        for (std::uint32_t number = 0; number < count; ++number) ASSERT_NO_THROW(use(arena, frame, n, {number, count}));
      }
  }
}

TEST(Passes, AreTheLeastPowerOfTwoThatFits) {
  shape::Random random(122);
  int several = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Frame frame = random_frame(random, random.whole(1, 4), 64);
    const FrameLoad load = frame.load(0);
    const std::uint64_t least = memory_for(load, 0, 128), most = memory_for(load, 0, 1);
    const std::uint64_t memory = least + (most - least) * static_cast<std::uint64_t>(random.whole(0, 100)) / 100;
    const std::uint32_t passes = passes_for(load, 0, memory);
    std::uint32_t expected = 1;
    while (memory_for(load, 0, expected) > memory) expected *= 2;
    EXPECT_EQ(passes, expected);
    several += passes > 1;
  }
  EXPECT_GT(several, 50);
}

TEST(Passes, SayWhatOneLineNeeds) {
  const Frame frame({{100'000, 0, 5}}, {50'000});
  try {
    passes_for(frame.load(0), 0, 3 << 20);
    FAIL() << "100,000 boxes of one line do not fit";
  } catch (const Failure& failure) {
    const std::string text = failure.what();
    EXPECT_NE(text.find("one line's edge boxes need 5 MiB, but a frame has 3 MiB"), std::string::npos) << text;
    EXPECT_NE(text.find("MARS_MEMORY"), std::string::npos) << text;
  }
}

struct Agreement {
  std::vector<std::uint32_t> passes;
  std::uint64_t messages = 0;  // for the agreement alone
};

// As nodes of a group on the threads backend, each with its own counts.
Agreement agree(const Frame& frame, std::uint64_t memory) {
  Agreement out{std::vector<std::uint32_t>(frame.nodes()), 0};
  messages::Counts counts;
  std::mutex mutex;
  const auto node = [&] {
    const auto self = static_cast<std::size_t>(mynode());
    const auto nodes = static_cast<int>(frame.nodes());
    GroupSums sums(frame.lines());
    FrameLoad load = frame.load(self);
    const MadeCounts made = frame.made(self);
    const bool large = is_large(group::own_bytes(made, frame.travels()), memory);
    sums.add_up({0, nodes}, {load.line_loads, made.edge_boxes, large});
    load.large = sums.large();
    EXPECT_TRUE(std::ranges::equal(sums.ebc(), load.ebc));
    const std::uint64_t before = counts.sent({.from = mynode()}).messages;
    out.passes[self] = agree_on_passes(load, memory);
    const std::lock_guard lock(mutex);
    out.messages += counts.sent({.from = mynode()}).messages - before;
  };
  threads::run_threads(
      static_cast<int>(frame.nodes()), [] {}, node, messages::counting(counts));
  return out;
}

// The second node has nearly all triangles, so that it alone is short of memory.
TEST(Passes, AllNodesTakeThoseOfTheShortest) {
  const std::vector<std::uint32_t> few(32, 1), many(32, 1000);
  const Frame frame({few, many, few}, {20, 32'000, 20});
  const std::uint64_t memory = memory_for(frame.load(1), 1, 4);
  ASSERT_GT(memory_for(frame.load(1), 1, 2), memory);
  ASSERT_LE(memory_for(frame.load(0), 0, 2), memory);
  const Agreement agreement = agree(frame, memory);
  EXPECT_EQ(agreement.passes, (std::vector<std::uint32_t>{4, 4, 4}));
  EXPECT_GT(agreement.messages, 0u);
}

TEST(Passes, NoMessageWhereOnePassFitsAll) {
  const std::vector<std::uint32_t> few(32, 1), many(32, 1000);
  const Agreement agreement = agree(Frame({few, many, few}, {20, 32'000, 20}), 64 << 20);
  EXPECT_EQ(agreement.passes, (std::vector<std::uint32_t>{1, 1, 1}));
  EXPECT_EQ(agreement.messages, 0u);
}

}  // namespace
}  // namespace mars::group
