// Nodes of a machine read each other's edge boxes and triangles where they lie, however far one of them is ahead.
#include "node/group/frame_memory.h"

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "hal/failure/failure.h"
#include "hal/nx/nx_messages.h"
#include "node/group/passes.h"
#include "tests/hal/machines_backend.h"

namespace mars::group {
namespace {

constexpr std::uint32_t kLineCount = 16;

// What a node makes of a frame: triangle k, of patch frame * 100 + node, has k edge boxes on line k.
raster::LineBoxes make(FrameMemory& memory, std::uint32_t frame) {
  raster::Arena& arena = memory.arena();
  const auto triangles = arena.take<geometry::Triangle>(kLineCount);
  std::vector<raster::UnsortedEdgeBox> boxes;
  std::vector<std::uint64_t> totals{0};
  for (std::uint32_t k = 0; k < kLineCount; ++k) {
    triangles[k] = {};
    triangles[k].patch = frame * 100 + static_cast<std::uint32_t>(mynode());
    const auto number = static_cast<std::uint32_t>(&triangles[k] - memory.first_triangle());
    for (std::uint32_t i = 0; i < k; ++i)
      boxes.push_back({{number, static_cast<std::uint32_t>(i), frame, 0}, static_cast<std::uint16_t>(k), 0});
    totals.push_back(boxes.size());
  }
  raster::LineFiller filler({0, kLineCount}, totals, memory.first_triangle(), arena);
  filler.add({memory.first_triangle(), boxes, {}});
  return filler.finish();
}

// Whether the part is what `node` made of the frame.
void expect_made(const FrameMemory& memory, const raster::LineBoxes& part, int node, std::uint32_t frame) {
  ASSERT_EQ(part.lines.last, kLineCount);
  for (std::uint32_t line = 0; line < kLineCount; ++line) {
    ASSERT_EQ(part.stationary(line).size(), line);
    for (const raster::EdgeBox& box : part.stationary(line)) {
      ASSERT_EQ(box.after, frame);
      ASSERT_EQ(memory.first_triangle()[box.triangle].patch, frame * 100 + static_cast<std::uint32_t>(node));
    }
  }
}

// Keyframes with zero to two inbetweens after them, drawn by nodes of which each is the slow one in turn.
void draw_film(int nodes, int nodes_each, std::uint32_t groups) {
  messages::Machines machines(nodes_each);
  messages::Counts counts;
  const auto node = [&] {
    std::vector<std::int32_t> machine_of;
    for (int n = 0; n < nodes; ++n) machine_of.push_back(n / nodes_each * nodes_each);
    const raster::Neighbours neighbours(machine_of, static_cast<int>(groups));
    const int self = static_cast<int>(mynode());
    collectives::Group group;
    for (int number = 0; number < static_cast<int>(groups); ++number) {
      group = collectives::group_of(nodes, static_cast<int>(groups), number);
      if (self < group.first + group.count) break;
    }
    FrameMemory memory(neighbours, 1 << 20);
    EXPECT_EQ(memory.readers().size() + 1, neighbours.nodes().size());
    for (std::uint32_t frame = 0; frame < 30; ++frame) {
      memory.begin_frame();
      const raster::LineBoxes own = make(memory, frame);
      memory.publish(own);
      wait_for_all(group);
      if (static_cast<int>(frame) % nodes == self) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      std::vector<raster::LineBoxes> parts;
      memory.read_published(parts);
      ASSERT_EQ(parts.size(), memory.readers().size());
      for (std::size_t i = 0; i < parts.size(); ++i) expect_made(memory, parts[i], memory.readers()[i], frame);
      expect_made(memory, own, self, frame);
      for (std::uint32_t inbetween = 0; inbetween < (frame + static_cast<std::uint32_t>(self)) % 3; ++inbetween) {
        memory.begin_frame();
        expect_made(memory, make(memory, 1000 + inbetween), self, 1000 + inbetween);
      }
    }
  };
  threads::run_threads(
      nodes, [] {}, node,
      [&](messages::Backend& inner) { return std::make_unique<messages::MachinesBackend>(inner, counts, machines); });
}

TEST(FrameMemory, NeighboursReadWhatWasPublished) {
  draw_film(4, 4, 1);
  draw_film(5, 3, 1);
  draw_film(6, 6, 2);
  draw_film(3, 1, 1);
  draw_film(1, 1, 1);
}

// A machine that gives shared memory for CZB, but not that much.
class SmallMachine : public messages::CountingBackend {
 public:
  using CountingBackend::CountingBackend;
  std::shared_ptr<std::byte> share(std::size_t bytes) override {
    if (bytes > 1 << 20) throw Failure("the machine does not share 4 MiB", "memory", "buy a larger one");
    return CountingBackend::share(bytes);
  }
};

TEST(FrameMemory, IsEachNodesOwnWhereTheMachineDoesNotShareIt) {
  messages::Counts counts;
  const auto node = [] {
    const raster::Neighbours neighbours(std::vector<std::int32_t>{0, 0}, 1);
    FrameMemory memory(neighbours, 4 << 20);
    EXPECT_EQ(memory.refusal(), "the machine does not share 4 MiB");
    EXPECT_TRUE(memory.readers().empty());
    EXPECT_FALSE(memory.reads(1 - static_cast<int>(mynode())));
    for (std::uint32_t frame = 0; frame < 3; ++frame) {
      memory.begin_frame();
      const raster::LineBoxes own = make(memory, frame);
      memory.publish(own);
      std::vector<raster::LineBoxes> parts;
      memory.read_published(parts);
      EXPECT_TRUE(parts.empty());
      expect_made(memory, own, static_cast<int>(mynode()), frame);
    }
  };
  threads::run_threads(
      2, [] {}, node, [&](messages::Backend& inner) { return std::make_unique<SmallMachine>(inner, counts); });
}

}  // namespace
}  // namespace mars::group
