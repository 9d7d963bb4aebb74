// Tasks of several frames put together from strips in every order that nodes can send them, against pictures
// drawn from scratch.
#include "host/render/farm/assembly.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <mutex>
#include <random>
#include <thread>

#include "tests/host/render/farm/strips.h"

namespace mars::farm {
namespace {

constexpr std::uint32_t kWidth = 40, kHeight = 24, kBlock = 8, kPlain = 3;

using Pixels = std::vector<std::uint32_t>;

class MemorySink : public sinks::Sink {
 public:
  void take(compositor::Frame& frame) override {
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
  for (const wire::Run& run : runs.runs)
    for (std::uint32_t x = 0; x < run.count; ++x) picture[run.line * kWidth + run.first + x] = *source++;
}

// A task's strips by node, as each sends them, and the pictures they make.
struct Drawn {
  std::vector<std::deque<StripBytes>> by_node;
  std::map<std::uint32_t, Pixels> pictures;
};

Drawn draw(std::mt19937& random, const Task& task, int nodes, StripStore& store) {
  Drawn out;
  out.by_node.resize(static_cast<std::size_t>(nodes));
  Pixels background(kWidth * kHeight, kPlain);
  std::map<std::uint32_t, std::vector<Runs>> moving;
  for (const std::uint32_t frame : task.frames) {
    const bool keyframe = frame == task.frames.front();
    const int contributors = keyframe ? nodes : 1;
    for (int contributor = 0; contributor < contributors; ++contributor) {
      const std::uint64_t inbetween = task.first_inbetween + frame - task.frames.front() - 1;
      const int node = keyframe ? contributor : wire::team_of_inbetween(inbetween, {0, nodes}, 0).first;
      const std::uint32_t passes = 1 + random() % 3;
      const std::uint32_t parts = static_cast<std::uint32_t>(contributors) * passes;
      for (std::uint32_t pass = 0; pass < passes; ++pass) {
        const std::uint32_t part = static_cast<std::uint32_t>(contributor) * passes + pass;
        const std::uint32_t top = kHeight * part / parts, bottom = kHeight * (part + 1) / parts;
        wire::Strip header{};
        header.frame = frame;
        header.interval = task.interval;
        header.kind = keyframe ? wire::FrameKind::keyframe : wire::FrameKind::inbetween;
        header.node = node;
        header.last = pass + 1 == passes;
        header.slot = static_cast<std::uint32_t>(random() % 4);
        header.by_message = 1;
        const Runs constant = keyframe ? random_runs(random, top, bottom) : Runs{};
        moving[frame].push_back(random_runs(random, top, bottom));
        paste(constant, background);
        auto& strips = out.by_node[static_cast<std::size_t>(node)];
        strips.push_back(strip_bytes(header, constant, moving[frame].back(), store));
      }
    }
  }
  for (const std::uint32_t frame : task.frames) {
    out.pictures[frame] = background;
    for (const Runs& runs : moving[frame]) paste(runs, out.pictures[frame]);
  }
  return out;
}

// Strips come in turns that chance decides; each node's in its order.
void expect_put_together(unsigned seed) {
  std::mt19937 random(seed);
  MemorySink sink;
  sinks::SinkPool pool(sink, {kWidth, kHeight, kBlock, 1 + static_cast<std::uint32_t>(random() % 4), 1, kPlain});
  compositor::Compositor compositor(kWidth, kHeight, kBlock);
  StripStore store;
  std::map<std::uint32_t, Pixels> expected;
  const int nodes = 1 + static_cast<int>(random() % 4);
  std::uint32_t next = 0;
  for (std::uint32_t number = 0; number < 4; ++number) {
    Task task{number, {}, random() % 5};
    const std::uint32_t frames = random() % 2 == 0 ? 1 : 2 + random() % 5;
    while (task.frames.size() < frames) task.frames.push_back(next++);
    Drawn drawn = draw(random, task, nodes, store);
    expected.merge(drawn.pictures);
    Assignments assignments(static_cast<std::size_t>(nodes));
    Assembly assembly(task, {0, nodes}, {nodes}, assignments);
    assembly.give(task, whole(task), assignments);
    compositor.begin_interval(kPlain);
    EXPECT_EQ(assembly.interval(), number);
    std::size_t not_pasted = 0;  // strips
    while (!assembly.done()) {
      auto& strips = drawn.by_node[random() % drawn.by_node.size()];
      if (random() % 2 == 0) assembly.prepare(compositor, pool);
      if (!strips.empty()) {
        std::optional<StripMessage> strip = StripMessage::read(std::move(strips.front()), wire::PixelFormat::rgb8);
        strips.pop_front();
        ASSERT_TRUE(strip && assignments.has(strip->header()) && assembly.has(strip->header().frame));
        if (strip->header().last == 1) assignments.end(strip->header());
        ++not_pasted;
        assembly.receive(std::move(*strip));
      }
      while (auto pasted = assembly.paste(compositor, pool, store)) {
        not_pasted -= pasted->free.size();
        EXPECT_EQ(pasted->kind == wire::FrameKind::keyframe, pasted->number == task.frames.front());
        if (pasted->whole == nullptr) continue;
        pool.submit(pasted->whole);
      }
    }
    EXPECT_EQ(not_pasted, 0u) << "each was reported when it was pasted";
    EXPECT_TRUE(assignments.all_idle());
  }
  pool.finish();
  EXPECT_EQ(sink.frames, expected) << "seed " << seed;
}

TEST(Assembly, PutsFramesTogetherFromStripsInAnyOrder) {
  for (unsigned seed = 0; seed < 300 && !testing::Test::HasFailure(); ++seed) expect_put_together(seed);
}

struct OneTask {
  OneTask(std::vector<std::uint32_t> frames, std::uint32_t buffers, int nodes)
      : pool(sink, {kWidth, kHeight, kBlock, buffers, 1, kPlain}),
        task{0, std::move(frames), 0},
        assignments(static_cast<std::size_t>(nodes)),
        assembly(task, {0, nodes}, {nodes}, assignments) {
    assembly.give(task, whole(task), assignments);
    compositor.begin_interval(kPlain);
  }

  void receive(std::uint32_t frame, int node, bool last = true) {
    wire::Strip header{};
    header.frame = frame;
    header.node = node;
    header.last = last;
    header.slot = 2;
    header.by_message = 1;
    assembly.receive(
        *StripMessage::read(strip_bytes(header, {}, {{{0, 0, 1}}, {frame}}, store), wire::PixelFormat::rgb8));
  }
  std::optional<Assembly::Pasted> paste() { return assembly.paste(compositor, pool, store); }

  MemorySink sink;
  sinks::SinkPool pool;
  compositor::Compositor compositor{kWidth, kHeight, kBlock};
  StripStore store;
  Task task;
  Assignments assignments;
  Assembly assembly;
};

TEST(Assembly, PastesAStripBeforeTheOthersAreThere) {
  OneTask task({5}, 2, 2);
  task.receive(5, 1, false);
  task.receive(5, 1);
  const auto first = task.paste();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->whole, nullptr);
  EXPECT_EQ(first->free, (std::vector<NodeSlot>{{1, 2}, {1, 2}}));
  EXPECT_FALSE(task.paste()) << "there is nothing more";
  task.receive(5, 0);
  const auto second = task.paste();
  ASSERT_TRUE(second && second->whole);
  EXPECT_EQ(second->free, (std::vector<NodeSlot>{{0, 2}}));
  EXPECT_TRUE(task.assembly.done());
}

TEST(Assembly, InbetweensWaitForTheKeyframe) {
  OneTask task({0, 1}, 3, 1);
  task.receive(1, 0);
  EXPECT_FALSE(task.paste());
  task.receive(0, 0);
  EXPECT_EQ(task.paste()->number, 0u);
  EXPECT_EQ(task.paste()->number, 1u);
  EXPECT_TRUE(task.assembly.done());
}

TEST(Assembly, FramesInTheMakingLeaveABufferToThoseThatAreWhole) {
  OneTask task({0, 1, 2}, 2, 1);
  task.receive(0, 0);
  task.pool.submit(task.paste()->whole);
  task.pool.finish();
  task.receive(1, 0, false);
  ASSERT_TRUE(task.paste());
  task.receive(2, 0);
  const auto whole = task.paste();
  ASSERT_TRUE(whole && whole->whole);
  EXPECT_EQ(whole->number, 2u);
  task.receive(1, 0);
  EXPECT_NE(task.paste()->whole, nullptr);
}

TEST(Assembly, GivesItsFramesToTheNodesThatDrawThem) {
  const Task task{3, {4, 5, 6, 7}, 0};
  Assignments assignments(5);
  Assembly assembly(task, {2, 3}, {2}, assignments);
  EXPECT_TRUE(assignments.is_given(2, {4, 3, wire::FrameKind::keyframe}));
  EXPECT_TRUE(assignments.is_given(3, {4, 3, wire::FrameKind::keyframe}));
  EXPECT_FALSE(assignments.is_given(4, {4, 3, wire::FrameKind::keyframe})) << "two contribute";
  assembly.give(task, {0, 2, {1}}, assignments);
  for (const std::uint32_t frame : {5u, 6u}) {
    EXPECT_TRUE(assignments.is_given(3, {frame, 3, wire::FrameKind::inbetween})) << frame;
    EXPECT_FALSE(assignments.is_given(2, {frame, 3, wire::FrameKind::inbetween})) << frame;
  }
  EXPECT_EQ(assignments.inbetweens(3, 3), 2u);
  assembly.give(task, {2, 1}, assignments);
  EXPECT_TRUE(assignments.is_given(4, {7, 3, wire::FrameKind::inbetween}));
}

TEST(Assembly, WithoutABufferStripsWait) {
  OneTask task({0, 1}, 1, 1);
  task.receive(0, 0);
  const auto keyframe = task.paste();
  task.receive(1, 0);
  EXPECT_FALSE(task.paste());
  task.pool.submit(keyframe->whole);
  task.pool.finish();
  EXPECT_TRUE(task.paste());
  EXPECT_TRUE(task.assembly.done());
}

}  // namespace
}  // namespace mars::farm
