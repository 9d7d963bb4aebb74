// Units of several frames put together from strips in every order that nodes can send them, against pictures
// drawn from scratch.
#include "host/render/farm/assembly.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <mutex>
#include <random>
#include <thread>

#include "tests/host/render/farm/strips.h"

namespace mars::host {
namespace {

constexpr std::uint32_t kWidth = 40, kHeight = 24, kBlock = 8, kPlain = 3;

using Pixels = std::vector<std::uint32_t>;

class MemorySink : public Sink {
 public:
  void take(const Frame& frame) override {
    const std::lock_guard lock(mutex_);
    EXPECT_TRUE(frames.emplace(frame.number, frame.pixels).second) << "frame " << frame.number << " came twice";
  }
  std::map<std::uint32_t, Pixels> frames;

 private:
  std::mutex mutex_;
};

Runs random_runs(std::mt19937& random, std::uint32_t top, std::uint32_t bottom) {
  Runs out;
  for (std::uint32_t run = top == bottom ? 0 : random() % 5; run > 0; --run) {
    const std::uint32_t first = random() % kWidth;
    const std::uint32_t count = 1 + random() % (kWidth - first);
    out.runs.push_back({static_cast<std::uint32_t>(top + random() % (bottom - top)), static_cast<std::uint16_t>(first),
                        static_cast<std::uint16_t>(count)});
    for (std::uint32_t i = 0; i < count; ++i) out.pixels.push_back(random());
  }
  return out;
}

void paste(const Runs& runs, Pixels& picture) {
  const std::uint32_t* source = runs.pixels.data();
  for (const node::Run& run : runs.runs)
    for (std::uint32_t x = 0; x < run.count; ++x) picture[run.line * kWidth + run.first + x] = *source++;
}

// A unit's strips by node, as each sends them, and the pictures they make.
struct Drawn {
  std::vector<std::deque<StripBytes>> by_node;
  std::map<std::uint32_t, Pixels> pictures;
};

Drawn draw(std::mt19937& random, const Unit& unit, int nodes, StripStore& store) {
  Drawn out;
  out.by_node.resize(static_cast<std::size_t>(nodes));
  Pixels background(kWidth * kHeight, kPlain);
  std::map<std::uint32_t, std::vector<Runs>> moving;
  for (const std::uint32_t frame : unit.frames) {
    const bool keyframe = frame == unit.frames.front();
    const int artists = keyframe ? nodes : 1;
    for (int artist = 0; artist < artists; ++artist) {
      const int node = keyframe ? artist : static_cast<int>(frame) % nodes;
      const std::uint32_t passes = 1 + random() % 3;
      const std::uint32_t parts = static_cast<std::uint32_t>(artists) * passes;
      for (std::uint32_t pass = 0; pass < passes; ++pass) {
        const std::uint32_t part = static_cast<std::uint32_t>(artist) * passes + pass;
        const std::uint32_t top = kHeight * part / parts, bottom = kHeight * (part + 1) / parts;
        node::Strip header{};
        header.frame = frame;
        header.kind = keyframe ? node::FrameKind::keyframe : node::FrameKind::inbetween;
        header.node = node;
        header.last = pass + 1 == passes;
        const Runs constant = keyframe ? random_runs(random, top, bottom) : Runs{};
        moving[frame].push_back(random_runs(random, top, bottom));
        paste(constant, background);
        auto& strips = out.by_node[static_cast<std::size_t>(node)];
        strips.push_back(strip_bytes(header, constant, moving[frame].back(), store));
      }
    }
  }
  for (const std::uint32_t frame : unit.frames) {
    out.pictures[frame] = background;
    for (const Runs& runs : moving[frame]) paste(runs, out.pictures[frame]);
  }
  return out;
}

// Strips come in turns that chance decides; each node's in its order.
void expect_put_together(unsigned seed) {
  std::mt19937 random(seed);
  MemorySink sink;
  SinkPool pool(sink, {kWidth, kHeight, kBlock, 1 + static_cast<std::uint32_t>(random() % 4), 1, kPlain});
  Compositor compositor(kWidth, kHeight, kBlock, kPlain);
  StripStore store;
  std::map<std::uint32_t, Pixels> expected;
  const int nodes = 1 + static_cast<int>(random() % 4);
  std::uint32_t next = 0;
  for (std::uint32_t number = 0; number < 4; ++number) {
    Unit unit{number, {}, 0};
    const std::uint32_t frames = random() % 2 == 0 ? 1 : 2 + random() % 5;
    while (unit.frames.size() < frames) unit.frames.push_back(next++);
    Drawn drawn = draw(random, unit, nodes, store);
    expected.merge(drawn.pictures);
    Assembly assembly(unit, nodes);
    EXPECT_EQ(assembly.interval(), number);
    std::vector<std::int32_t> artists;
    while (!assembly.done()) {
      auto& strips = drawn.by_node[random() % drawn.by_node.size()];
      if (random() % 2 == 0) assembly.prepare(compositor, pool);
      if (!strips.empty()) {
        StripMessage strip(std::move(strips.front()));
        strips.pop_front();
        ASSERT_TRUE(assembly.wants(strip.header().frame));
        assembly.receive(std::move(strip));
      }
      while (auto pasted = assembly.paste(compositor, pool, store)) {
        EXPECT_EQ(pasted->kind == node::FrameKind::keyframe, pasted->number == unit.frames.front());
        if (pasted->whole == nullptr) continue;
        EXPECT_FALSE(assembly.wants(pasted->number));
        EXPECT_EQ(pasted->nodes.size(), pasted->number == unit.frames.front() ? static_cast<std::size_t>(nodes) : 1u);
        pool.submit(pasted->whole);
      }
    }
    compositor.begin_interval();
  }
  pool.finish();
  EXPECT_EQ(sink.frames, expected) << "seed " << seed;
}

TEST(Assembly, PutsFramesTogetherFromStripsInAnyOrder) {
  for (unsigned seed = 0; seed < 300 && !testing::Test::HasFailure(); ++seed) expect_put_together(seed);
}

struct OneUnit {
  OneUnit(std::vector<std::uint32_t> frames, std::uint32_t buffers, int nodes)
      : pool(sink, {kWidth, kHeight, kBlock, buffers, 1, kPlain}), assembly({0, std::move(frames), 0}, nodes) {}

  void receive(std::uint32_t frame, int node, bool last = true) {
    node::Strip header{};
    header.frame = frame;
    header.node = node;
    header.last = last;
    assembly.receive(StripMessage(strip_bytes(header, {}, {{{0, 0, 1}}, {frame}}, store)));
  }
  std::optional<Assembly::Pasted> paste() { return assembly.paste(compositor, pool, store); }

  MemorySink sink;
  SinkPool pool;
  Compositor compositor{kWidth, kHeight, kBlock, kPlain};
  StripStore store;
  Assembly assembly;
};

TEST(Assembly, PastesAStripBeforeTheOthersAreThere) {
  OneUnit unit({5}, 2, 2);
  unit.receive(5, 1);
  const auto first = unit.paste();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->whole, nullptr);
  EXPECT_FALSE(unit.paste()) << "there is nothing more";
  EXPECT_TRUE(unit.assembly.wants(5));
  unit.receive(5, 0);
  const auto second = unit.paste();
  ASSERT_TRUE(second && second->whole);
  EXPECT_EQ(second->nodes, (std::vector<std::int32_t>{1, 0}));
  EXPECT_TRUE(unit.assembly.done());
}

TEST(Assembly, InbetweensWaitForTheKeyframe) {
  OneUnit unit({0, 1}, 3, 1);
  unit.receive(1, 0);
  EXPECT_FALSE(unit.paste());
  unit.receive(0, 0);
  EXPECT_EQ(unit.paste()->number, 0u);
  EXPECT_EQ(unit.paste()->number, 1u);
  EXPECT_TRUE(unit.assembly.done());
}

TEST(Assembly, FramesInTheMakingLeaveABufferToThoseThatAreWhole) {
  OneUnit unit({0, 1, 2}, 2, 1);
  unit.receive(0, 0);
  unit.pool.submit(unit.paste()->whole);
  unit.pool.finish();
  unit.receive(1, 0, false);
  ASSERT_TRUE(unit.paste());
  unit.receive(2, 0);
  const auto whole = unit.paste();
  ASSERT_TRUE(whole && whole->whole);
  EXPECT_EQ(whole->number, 2u);
  unit.receive(1, 0);
  EXPECT_NE(unit.paste()->whole, nullptr);
}

TEST(Assembly, WithoutABufferStripsWait) {
  OneUnit unit({0, 1}, 1, 1);
  unit.receive(0, 0);
  const auto keyframe = unit.paste();
  unit.receive(1, 0);
  EXPECT_FALSE(unit.paste());
  unit.pool.submit(keyframe->whole);
  unit.pool.finish();
  EXPECT_TRUE(unit.paste());
  EXPECT_TRUE(unit.assembly.done());
}

}  // namespace
}  // namespace mars::host
