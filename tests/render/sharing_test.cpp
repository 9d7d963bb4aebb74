// CZB is shared by the nodes of a group on one machine: the pictures stay the same wherever the nodes are and
// whichever of them is slow, and lines go once to every other machine.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "hal/failure/failure.h"
#include "host/content/modeler/primitives.h"
#include "tests/hal/machines_backend.h"
#include "tests/render/film_run.h"
#include "tests/render/films.h"
#include "tests/render/looks.h"

namespace mars::test {
namespace {

constexpr std::uint32_t kWidth = 160, kHeight = 120, kFrames = 12;

wire::FilmData film(std::uint32_t interval, std::uint32_t samples = 1) {
  return with_samples(crowd(kWidth, kHeight, kFrames, interval), samples);
}

constexpr long kLooks = 0;  // in place of a message's type

// One node sleeps before each message of one type that it sends, or before each look for messages: so also between the
// sum of EBC and its first line.
class SlowNode : public messages::MachinesBackend {
 public:
  SlowNode(messages::Backend& inner, messages::Counts& counts, messages::Machines& machines, int node, long type)
      : messages::MachinesBackend(inner, counts, machines), node_(node), type_(type) {}

  messages::Ticket start_send(int to, int type, const void* data, std::size_t length) override {
    if (rank() == node_ && type == type_) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    return messages::MachinesBackend::start_send(to, type, data, length);
  }
  std::optional<messages::Envelope> peek() override {
    if (rank() == node_ && type_ == kLooks) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return messages::MachinesBackend::peek();
  }

 private:
  int node_;
  long type_;
};

// The second machine shares film and CZB among its nodes, but not their frames' memory. Counts the nodes that say so.
class SmallMachine : public messages::MachinesBackend {
 public:
  SmallMachine(messages::Backend& inner, messages::Counts& counts, messages::Machines& machines,
               std::atomic<int>& apart)
      : messages::MachinesBackend(inner, counts, machines), apart_(apart) {}

  std::optional<messages::Ticket> send_or_start(int to, int type, const void* data, std::size_t length) override {
    if (type == wire::kLoaded && std::string(static_cast<const wire::Loaded*>(data)->apart.data()) == kReason) ++apart_;
    return MachinesBackend::send_or_start(to, type, data, length);
  }
  std::shared_ptr<std::byte> share(std::size_t bytes) override {
    if (neighbourhood().machine > 0 && bytes > kMost) throw Failure(kReason, "", "");
    return MachinesBackend::share(bytes);
  }

 private:
  static constexpr std::size_t kMost = 16 << 20;
  static constexpr const char* kReason = "there is too little";

  std::atomic<int>& apart_;
};

struct SharedRun {
  FilmRun film;
  messages::Counts counts;
  std::size_t shared = 0;
};

struct Nodes {
  int count;
  int each;  // on its machines
  std::uint32_t groups = 1;
};

void PrintTo(const Nodes& n, std::ostream* out) {
  *out << n.count << " nodes, " << n.each << " a machine, " << n.groups << " groups";
}

RunOptions options_of(const Nodes& nodes, std::uint64_t memory) {
  RunOptions options;
  options.nodes = nodes.count;
  options.work.groups = nodes.groups;
  options.memory = memory;
  return options;
}

void run(const wire::FilmData& data, const Nodes& nodes, SharedRun& out, int slow = -1, long slow_type = wire::kStrip,
         std::uint64_t memory = 256 << 20, wire::Exchange exchange = wire::Exchange::send) {
  messages::Machines machines(nodes.each);
  RunOptions options = options_of(nodes, memory);
  options.farm.exchange = exchange;
  options.wrap = [&](messages::Backend& inner) {
    return std::make_unique<SlowNode>(inner, out.counts, machines, slow, slow_type);
  };
  out.film = run_film(FilmBlock(data).bytes(), options);
  out.shared = machines.shared();
}

FilmRun from_scratch(const wire::FilmData& data) {
  RunOptions options;
  options.work.coherence = false;
  return run_film(FilmBlock(data).bytes(), options);
}

void expect_pictures(const SharedRun& rendered, const wire::FilmData& data, const FilmRun& expected) {
  ASSERT_EQ(rendered.film.frames.size(), kFrames);
  expect_same(rendered.film, expected, data.settings, "sharing");
}

std::uint64_t depth_bytes(const SharedRun& run) { return run.counts.sent({.type = wire::kStillLines}).bytes; }

// Of a message of still lines, before these.
constexpr std::uint64_t kMostHeads = 64;

TEST(Sharing, AnyMachinesAndGroups) {
  for (const auto& [interval, samples] : {std::pair{4u, 1u}, {1u, 1u}, {4u, 4u}}) {
    const wire::FilmData data = film(interval, samples);
    const FilmRun expected = from_scratch(data);
    for (const int each : {6, 5, 4, 3, 2, 1})
      for (const std::uint32_t groups : {1u, 2u, 3u, 6u}) {
        const Nodes nodes{6, each, groups};
        SCOPED_TRACE(testing::PrintToString(nodes));
        SharedRun rendered;
        run(data, nodes, rendered);
        expect_pictures(rendered, data, expected);
      }
  }
}

// While one node has not begun to draw a pass the others make the triangles of the next.
TEST(Sharing, InSeveralPasses) {
  for (const std::uint32_t samples : {1u, 4u}) {
    const wire::FilmData data = film(4, samples);
    const FilmRun expected = from_scratch(data);
    for (const int each : {4, 2}) {
      SharedRun rendered;
      run(data, {4, each}, rendered, 1, kLooks, samples == 1 ? 200'000 : 600'000);
      EXPECT_GT(rendered.film.report.strips.front().work.passes, 1u);
      expect_pictures(rendered, data, expected);
    }
  }
}

// While one node is late with its inbetweens the others have come to the next keyframe; while it is late with its
// home lines they want to begin with theirs; while it has not read their triangles they make others.
void expect_slow_nodes_waited_for(std::uint32_t samples) {
  const wire::FilmData data = film(3, samples);
  const FilmRun expected = from_scratch(data);
  for (const int each : {4, 2})
    for (int slow = 0; slow < 4; ++slow)
      for (const long type : {long{wire::kStrip}, long{wire::kTriangles}, long{wire::kStillLines}, kLooks}) {
        SCOPED_TRACE(std::to_string(each) + " a machine, node " + std::to_string(slow) + ", type " +
                     std::to_string(type));
        SharedRun rendered;
        run(data, {4, each}, rendered, slow, type);
        expect_pictures(rendered, data, expected);
      }
}

TEST(Sharing, ASlowNodeIsWaitedFor) { expect_slow_nodes_waited_for(1); }

TEST(Sharing, ASlowNodeIsWaitedForWithSamples) { expect_slow_nodes_waited_for(4); }

TEST(Sharing, NodesThatCannotReadEachOthersTrianglesSendThem) {
  const wire::FilmData data = film(4);
  messages::Machines machines(2);
  SharedRun rendered;
  std::atomic<int> apart = 0;
  RunOptions options;
  options.nodes = 4;
  options.work.groups = 1;
  options.wrap = [&](messages::Backend& inner) {
    return std::make_unique<SmallMachine>(inner, rendered.counts, machines, apart);
  };
  rendered.film = run_film(FilmBlock(data).bytes(), options);
  expect_pictures(rendered, data, from_scratch(data));
  const auto messages = [&](int from, int to) {
    return rendered.counts.sent({.from = from, .to = to, .type = wire::kTriangles}).messages;
  };
  EXPECT_EQ(messages(0, 1) + messages(1, 0), 0u);
  EXPECT_GT(messages(2, 3), 0u);
  EXPECT_GT(messages(3, 2), 0u);
  EXPECT_EQ(apart, 2);
}

// Of all keyframes.
std::uint64_t patches_diced(const SharedRun& run) {
  std::uint64_t patches = 0;
  for (const wire::Strip& strip : run.film.report.strips)
    if (strip.last == 1 && strip.kind == wire::FrameKind::keyframe) patches += strip.work.patches;
  return patches;
}

TEST(Sharing, TrianglesAreSentOrMadeAgain) {
  for (const std::uint32_t samples : {1u, 4u}) {
    const wire::FilmData data = film(1, samples);
    const FilmRun expected = from_scratch(data);
    for (const Nodes& nodes : {Nodes{4, 2}, {4, 1}, {6, 3}, {5, 2}, {6, 1, 2}}) {
      SCOPED_TRACE(testing::PrintToString(nodes));
      SharedRun sent, chosen, again;
      run(data, nodes, sent);
      run(data, nodes, chosen, 1, wire::kTriangles, 256 << 20, wire::Exchange::automatic);
      run(data, nodes, again, -1, wire::kStrip, 256 << 20, wire::Exchange::again);
      for (const SharedRun* rendered : {&chosen, &again}) expect_pictures(*rendered, data, expected);
      const auto messages = [](const SharedRun& run) { return run.counts.sent({.type = wire::kTriangles}).messages; };
      EXPECT_EQ(messages(again), 0u);
      EXPECT_GT(messages(chosen), 0u);
      EXPECT_LE(messages(chosen), messages(sent));
      EXPECT_GT(patches_diced(again), patches_diced(sent));
      EXPECT_LT(patches_diced(again), static_cast<std::uint64_t>(nodes.count) * patches_diced(sent));
    }
  }
}

TEST(Sharing, NoLineOfCzbTravelsOnOneMachine) {
  SharedRun rendered;
  run(film(6), {4, 4}, rendered);
  EXPECT_EQ(depth_bytes(rendered), 0u);
}

// What all machines but a line's own receive of it, however many nodes they have.
TEST(Sharing, LinesTravelOnceToEachMachine) {
  SharedRun two_nodes, six_nodes;
  run(film(6), {2, 1}, two_nodes);
  run(film(6), {6, 3}, six_nodes);
  const std::uint64_t bytes = depth_bytes(two_nodes);
  EXPECT_GT(bytes, 0u);
  EXPECT_LE(bytes, std::uint64_t{kWidth} * kHeight * sizeof(float) * kFrames / 6);
  EXPECT_NEAR(static_cast<double>(depth_bytes(six_nodes)), static_cast<double>(bytes),
              static_cast<double>(kMostHeads * six_nodes.counts.sent({.type = wire::kStillLines}).messages));
}

// Of all frames.
std::uint64_t lines_drawn_again(const SharedRun& run) {
  std::uint64_t lines = 0;
  for (const wire::Strip& strip : run.film.report.strips) {
    if (strip.last == 1) lines += strip.work.lines_drawn_again;
    EXPECT_TRUE(strip.kind == wire::FrameKind::inbetween || strip.work.lines_drawn_again == 0);
  }
  return lines;
}

// Nodes that each have `still` bytes for what inbetweens need.
void run_with(std::uint64_t still, const wire::FilmData& data, const Nodes& nodes, SharedRun& out,
              std::uint64_t memory = 256 << 20, std::uint32_t cut = 0) {
  messages::Machines machines(nodes.each);
  RunOptions options = options_of(nodes, memory);
  options.farm.asked_memory.still = still;
  options.work.most_frames = cut;
  options.wrap = [&](messages::Backend& inner) {
    return std::make_unique<messages::MachinesBackend>(inner, out.counts, machines);
  };
  out.film = run_film(FilmBlock(data).bytes(), options);
}

// Machines with memory for no line, for some and for all; not all have as many nodes.
TEST(Sharing, LinesThatAreNotKeptAreDrawnAgain) {
  const wire::FilmData data = film(4, 4);
  const FilmRun expected = from_scratch(data);
  constexpr std::uint64_t kLine = 64 + kWidth * (4 * 4 + 4 + 16);  // with one group a column
  for (const Nodes& nodes : {Nodes{1, 1}, {5, 3}, {4, 1}, {4, 2, 2}, {3, 3}}) {
    std::uint64_t before = ~std::uint64_t{0};
    for (const std::uint64_t still : {std::uint64_t{0}, 10 * kLine, 10 * kHeight * kLine}) {
      SCOPED_TRACE(testing::PrintToString(nodes) + ", " + std::to_string(still) + " bytes");
      SharedRun rendered;
      run_with(still, data, nodes, rendered);
      expect_pictures(rendered, data, expected);
      const std::uint64_t lines = lines_drawn_again(rendered);
      EXPECT_TRUE(lines < before || lines == 0) << lines;
      EXPECT_EQ(lines == 0, still == 10 * kHeight * kLine);
      before = lines;
    }
  }
}

// A box goes from where nothing stands still to where many balls do.
wire::FilmData uneven() {
  FilmMaker maker(kWidth, kHeight, kFrames);
  const std::uint32_t ball = maker.add_shape(modeler::make_sphere()), box = maker.add_shape(modeler::make_box());
  const std::uint32_t clay = maker.add_material(kClay);
  for (int x = 0; x < 16; ++x)
    for (int z = 0; z < 20; ++z) maker.add_segment(ball, clay, {placed({0.25 * x, 0, 0.25 * z - 2.5}, 0.3)});
  std::vector<wire::Matrix> motion;
  for (std::uint32_t f = 0; f < kFrames; ++f) motion.push_back(placed({0.5 * f - 3, -2, -0.7}, 0.5));
  maker.add_segment(box, clay, motion);
  maker.set_cameras({looking({0, -20, 0}, {0, 0, 0}, 20)});
  return with_samples(maker.make(), 16);
}

// Each piece of an interval that is cut has a keyframe and lines of its own: a line that is kept in a piece and does
// not fit in the next is drawn again there.
TEST(Sharing, LinesAreOfTheirPieceOfAnInterval) {
  const wire::FilmData data = uneven();
  const FilmRun expected = from_scratch(data);
  for (const std::uint64_t still : {100'000, 500'000}) {
    SharedRun rendered;
    run_with(still, data, {2, 1}, rendered, 256 << 20, 4);
    expect_pictures(rendered, data, expected);
    EXPECT_GT(lines_drawn_again(rendered), 0u);
  }
}

// Many lines are one message; lines that are not kept take nothing of it.
TEST(Sharing, KeptLinesTravelTogether) {
  const wire::FilmData data = film(6, 4);
  const auto sent = [&](std::uint64_t still) {
    SharedRun rendered;
    run_with(still, data, {3, 1}, rendered);
    return rendered.counts.sent({.type = wire::kStillLines});
  };
  const auto none = sent(0), few = sent(50'000), all = sent(10'000'000);
  constexpr std::uint64_t kParts = 2 * 3 * 2;  // of two intervals, of three nodes, to two others each
  EXPECT_EQ(none.messages, kParts);
  EXPECT_LE(none.bytes, kParts * kMostHeads);
  EXPECT_GT(few.bytes, none.bytes);
  EXPECT_GT(all.bytes, few.bytes);
  EXPECT_GT(all.messages, kParts);
  EXPECT_LT(all.messages, kParts + all.bytes / 30'000);
}

// Its triangles too may not fit: an inbetween then draws both in several passes.
TEST(Sharing, LinesAreDrawnAgainInSeveralPasses) {
  const wire::FilmData data = film(4, 4);
  SharedRun rendered;
  run_with(0, data, {2, 1}, rendered, 600'000);
  expect_pictures(rendered, data, from_scratch(data));
  EXPECT_TRUE(std::ranges::any_of(rendered.film.report.strips, [](const wire::Strip& strip) {
    return strip.kind == wire::FrameKind::inbetween && strip.work.passes > 1 && strip.work.lines_drawn_again > 0;
  }));
}

TEST(Sharing, OneCzbForEachGroupWithSeveralNodesOnAMachine) {
  constexpr std::size_t kCzb = kWidth * kHeight * sizeof(float);
  const auto shared = [](const Nodes& nodes) {
    SharedRun rendered;
    run(film(4), nodes, rendered);
    return rendered.shared;
  };
  EXPECT_EQ(shared({6, 6, 1}), kCzb);
  EXPECT_EQ(shared({6, 6, 2}), 2 * kCzb);
  EXPECT_EQ(shared({6, 3, 1}), 2 * kCzb);
  EXPECT_EQ(shared({6, 3, 2}), 2 * kCzb);
  EXPECT_EQ(shared({6, 4, 2}), 2 * kCzb) << "nodes 0 to 2; 4 and 5. Node 3 is apart from its mates";
  EXPECT_EQ(shared({6, 6, 6}), 0u) << "a group of one node shares with none";
}

// Where there is no inbetween nothing is shared, and no node hears of it.
TEST(Sharing, NothingWithoutInbetweens) {
  SharedRun rendered;
  run(film(1), {4, 2}, rendered);
  EXPECT_EQ(rendered.counts.sent({.type = wire::kStillLines}).messages, 0u);
}

}  // namespace
}  // namespace mars::test
