// The farm with nodes that follow a script.
#include "host/render/farm/farm.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <set>
#include <string_view>
#include <thread>

#include "host/render/farm/node_inbox.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/host/render/farm/scripted_node.h"
#include "tests/host/render/farm/slow_link.h"

namespace mars::farm {
namespace {

// Those with odd numbers are on other machines than the host.
void sound_node() {
  ScriptedNode node(mynode() % 2 == 0);
  node.boot();
  node.draw_all();
}

// Frames of intervals over nodes in groups: all arrive, each as its contributors drew it.
void expect_all_frames(const EmptyFilm& film, int nodes, std::uint32_t groups,
                       const std::vector<std::uint32_t>& frames) {
  ScriptedRun run;
  run.nodes = nodes;
  run.work = {frames, true, groups};
  const FarmReport report = run.render(film, sound_node);
  EXPECT_EQ(run.sink.pixels, pixels_of(frames)) << nodes << " nodes, " << groups << " groups";
  EXPECT_FALSE(report.cancelled);
  EXPECT_TRUE(report.strips.empty() && report.frames.empty()) << "nobody asked for a report";
}

TEST(Farm, EveryFrameComes) {
  const EmptyFilm film({5, 5, 2});
  for (const int nodes : {1, 2, 5}) {
    expect_all_frames(film, nodes, 1, frames_to(12));
    expect_all_frames(film, nodes, 2, frames_to(12));
    expect_all_frames(film, nodes, 5, frames_to(12));  // more groups than tasks
  }
  expect_all_frames(film, 3, 1, {7});
  expect_all_frames(film, 3, 3, {0, 4, 11});
}

// Intervals by turns of two exposures, frames of them in few buffers.
TEST(Farm, TheBackgroundIsThatOfItsInterval) {
  wire::FilmData data = EmptyFilm::data({2, 1, 3, 1});
  data.settings.color_space = wire::ColorSpace::linear;
  data.settings.background = {0.1f, 0.2f, 0.25f};
  data.cameras.push_back(data.cameras.front());
  data.cameras.back().exposure = 2;
  data.settings.camera = {0, 4};
  data.changes = {{0, 0}, {2, 1}, {3, 0}, {6, 1}};
  for (const wire::PixelFormat format : {wire::PixelFormat::rgb8, wire::PixelFormat::rgb16}) {
    ScriptedRun run;
    run.nodes = 2;
    run.work = {frames_to(7), true, 1};
    run.buffers = 2;
    run.format = format;
    run.render(EmptyFilm::of(data), sound_node);
    EXPECT_EQ(run.sink.pixels, pixels_of(frames_to(7)));
    // sRGB of 0.25 is 136.96 of 255, and of 0.5 187.52.
    const int shift = format == wire::PixelFormat::rgb8 ? 16 : 0;
    const double most = format == wire::PixelFormat::rgb8 ? 255 : 65535;
    for (const auto& [frame, word] : run.sink.last)
      EXPECT_NEAR((word >> shift) / most, (frame == 2 || frame == 6 ? 187.52 : 136.96) / 255, 0.6 / 255) << frame;
  }
}

// Each frame in two strips, which come by message.
void node_elsewhere() {
  ScriptedNode node(false);
  node.boot();
  while (const auto command = node.next_command())
    for (const std::uint32_t frame : ScriptedNode::own_frames(*command))
      for (const std::uint16_t last : {0, 1}) {
        wire::Strip strip = ScriptedNode::strip_of(*command, frame);
        strip.number = last;
        strip.last = last;
        if (!node.wait_for_credit()) return;
        node.send_strip(strip, 1000 + frame);
      }
}

TEST(Farm, ASlowLinkHoldsUpNoOtherNode) {
  messages::Counts counts;
  ScriptedRun run;
  run.nodes = 2;
  run.work = {frames_to(20), true, 2};
  run.farm.each_frame = true;
  run.wrap = [&](messages::Backend& inner) { return std::make_unique<SlowLink>(inner, counts); };
  const FarmReport report = run.render(EmptyFilm(std::vector<std::uint32_t>(20, 1)), node_elsewhere);
  EXPECT_EQ(run.sink.pixels, pixels_of(frames_to(20)));
  const auto slow = std::ranges::count(report.frames, 1, &FinishedFrame::first_node);
  EXPECT_GE(slow, 1);
  EXPECT_LE(slow, 5) << "the other node waited for this one's strips";
}

// Node 0 writes the files of its frames; node 1, which does not see the folder, sends strips.
void node_of_machine_with_orders(int machine) {
  ScriptedNode node;
  wire::Hello hello = ScriptedNode::hello();
  hello.machine = machine;
  ScriptedNode::send(wire::kHello, hello);
  node.take_load();
  wire::Loaded loaded = node.loaded();
  loaded.unseen = mynode() == 1 ? 1 : 0;
  ScriptedNode::send(wire::kLoaded, loaded);
  if (mynode() == 0) {
    EXPECT_TRUE(ScriptedNode::receive(wire::kWrite).empty());
  }
  while (const auto command = node.next_command()) {
    for (const std::uint32_t frame : ScriptedNode::own_frames(*command)) {
      const wire::Strip strip = ScriptedNode::strip_of(*command, frame);
      if (mynode() == 1) {
        if (!node.wait_for_credit()) return;
        node.send_strip(strip, 1000 + frame);
      } else {
        ScriptedNode::send(wire::kDrawn, strip);
        ScriptedNode::send(wire::kWritten, wire::Written{frame, 0, {}, 1, 0});
      }
    }
  }
}

void node_with_orders() { node_of_machine_with_orders(static_cast<int>(mynode())); }

struct WritingRun {
  ScriptedRun run;
  Writing writing;
  std::set<std::uint32_t> written;
  std::vector<std::string> warnings;

  explicit WritingRun(std::uint32_t groups) {
    run.nodes = 2;
    run.work = {frames_to(12), true, groups};
    writing.shares_folder = [](const wire::Hello& first) {
      EXPECT_EQ(first.node, 0) << "the other says itself that it does not see the folder";
      return true;
    };
    writing.written = [this](const wire::Written& file) { written.insert(file.frame); };
    run.farm.writing = &writing;
    run.listener.warned = [this](const std::string& text) { warnings.push_back(text); };
  }
};

TEST(Farm, GroupsThatDoNotSeeTheFolderSendTheirPicturesToTheHost) {
  WritingRun writing(2);
  writing.run.render(EmptyFilm({3, 3, 3, 3}), node_with_orders);
  EXPECT_GE(writing.written.size(), 3u);
  EXPECT_GE(writing.run.sink.pixels.size(), 3u);
  EXPECT_EQ(writing.written.size() + writing.run.sink.pixels.size(), 12u);
  for (const auto& [frame, pixel] : writing.run.sink.pixels) {
    EXPECT_EQ(pixel, 1000 + frame);
    EXPECT_FALSE(writing.written.contains(frame));
  }
  EXPECT_EQ(writing.warnings,
            std::vector<std::string>{"n1 does not see the folder of frames as the host does: the host composes and "
                                     "writes the frames of 1 of the 2 groups of nodes, which have nodes there"});
}

void node_without_orders() {
  ScriptedNode node;
  node.boot();
  node.draw_all();
}

// Each inbetween is whole when all nodes of its team have sent their last strips. Teams take turns; where slow nodes
// are looked for, a team that this machine holds up may pass its turn on.
TEST(Farm, GivesInbetweensToTeams) {
  const std::vector<std::vector<std::int32_t>> teams = {{2, 3, 4}, {0, 1}};
  for (const bool adapts : {false, true}) {
    ScriptedRun run;
    run.nodes = 5;
    run.work.frames = frames_to(40);
    run.work.sharers = 2;
    run.farm.each_frame = true;
    run.farm.adapts = adapts;
    const FarmReport report = run.render(EmptyFilm({40}), sound_node);
    EXPECT_EQ(run.sink.pixels, pixels_of(run.work.frames));
    std::map<std::uint32_t, std::vector<std::int32_t>> nodes;
    for (const wire::Strip& strip : report.strips)
      if (strip.kind == wire::FrameKind::inbetween) nodes[strip.frame].push_back(strip.node);
    EXPECT_EQ(nodes.size(), 39u);
    for (auto& [frame, of_frame] : nodes) {
      std::ranges::sort(of_frame);
      if (adapts)
        EXPECT_TRUE(of_frame == teams[0] || of_frame == teams[1]) << frame;
      else
        EXPECT_EQ(of_frame, teams[frame % 2]) << frame;
    }
    for (const FinishedFrame& frame : report.frames)
      if (frame.kind == wire::FrameKind::inbetween) {
        EXPECT_EQ(frame.nodes, nodes[frame.number].size());
      }
  }
}

TEST(Farm, NodesWriteWhereThatIsWanted) {
  WritingRun writing(2);
  std::size_t asked_of = 0;
  writing.writing.is_wanted = [&](std::span<const wire::Hello> nodes) {
    asked_of = nodes.size();
    return false;
  };
  writing.run.render(EmptyFilm({3, 3, 3, 3}), node_without_orders);
  EXPECT_EQ(asked_of, 2u);
  EXPECT_EQ(writing.run.sink.pixels.size(), 12u);
  EXPECT_TRUE(writing.written.empty());

  WritingRun wanted(2);
  wanted.writing.is_wanted = [](std::span<const wire::Hello>) { return true; };
  wanted.run.render(EmptyFilm({3, 3, 3, 3}), node_with_orders);
  EXPECT_EQ(wanted.written.size() + wanted.run.sink.pixels.size(), 12u);
  EXPECT_GE(wanted.written.size(), 3u);
}

TEST(Farm, AFolderThatNoMachineSeesIsNoWarningWhereTheHostMayWrite) {
  WritingRun writing(2);
  writing.writing.is_wanted = [](std::span<const wire::Hello>) { return true; };
  writing.writing.shares_folder = [](const wire::Hello&) { return false; };
  writing.run.render(EmptyFilm({3, 3, 3, 3}), node_without_orders);
  EXPECT_EQ(writing.run.sink.pixels.size(), 12u);
  EXPECT_TRUE(writing.warnings.empty());
}

// As in a container of its own.
TEST(Farm, ANodeThatDoesNotSeeTheFolderOfItsMachineLeavesItsFramesToTheHost) {
  WritingRun writing(2);
  writing.run.render(EmptyFilm({3, 3, 3, 3}), [] { node_of_machine_with_orders(0); });
  EXPECT_GE(writing.written.size(), 3u);
  EXPECT_GE(writing.run.sink.pixels.size(), 3u);
  EXPECT_EQ(writing.warnings.size(), 1u);
}

TEST(Farm, ANodeThatSendsStripsOfFramesThatItIsToWriteIsRefused) {
  WritingRun writing(2);
  const auto run = [&] {
    writing.run.render(EmptyFilm({3, 3, 3, 3}), [] {
      ScriptedNode node;
      node.boot();
      node.draw_all();
    });
  };
  writing.writing.shares_folder = [](const wire::Hello& first) { return first.node == 1; };
  const std::string failure = document::failure_of(run);
  EXPECT_TRUE(document::holds(failure, "n1 (node 1): sent a strip of frame")) << failure;
}

TEST(Farm, WarnsOnceOfEachMachineWhoseNodesDoNotShareMemory) {
  ScriptedRun run;
  run.nodes = 4;
  run.work = {frames_to(2), true, 1};
  std::vector<std::string> warnings;
  run.listener.warned = [&](const std::string& text) { warnings.push_back(text); };
  run.render(EmptyFilm({1, 1}), [] {
    ScriptedNode node;
    wire::Hello hello = ScriptedNode::hello();
    hello.host = {'n', static_cast<char>('0' + mynode() / 2)};
    ScriptedNode::send(wire::kHello, hello);
    if (!node.take_load()) return;
    wire::Loaded loaded = node.loaded();
    if (mynode() < 2) std::ranges::copy(std::string_view("no room"), loaded.apart.begin());
    ScriptedNode::send(wire::kLoaded, loaded);
    node.draw_all();
  });
  EXPECT_EQ(warnings, std::vector<std::string>{
                          "nodes on n0 do not read each other's triangles in place (no room): they "
                          "send them, which takes longer; raise the limit, or set MARS_MEMORY to fewer MiB"});
}

TEST(Farm, ReportsEachFrameWhereItIsAskedTo) {
  const EmptyFilm film({3, 2});
  ScriptedRun run;
  run.nodes = 2;
  run.work = {frames_to(5), true, 1};
  run.farm.each_frame = true;
  const FarmReport report = run.render(film, sound_node);
  EXPECT_EQ(report.frames.size(), 5u);
  EXPECT_EQ(report.strips.size(), 2u * 2 + 3) << "keyframes from both, inbetweens from one";
  EXPECT_EQ(report.nodes.size(), 2u);
  EXPECT_EQ(report.nodes[1].host.data(), std::string("n1"));
}

// Each node sends what it has of two tasks, the later first, inbetweens before keyframes.
TEST(Farm, StripsMayComeInAnyOrder) {
  const EmptyFilm film({2, 2});
  ScriptedRun run;
  run.nodes = 2;
  run.work = {frames_to(4), true, 1};
  run.render(film, [] {
    ScriptedNode node;
    node.boot();
    const std::vector<ScriptedNode::Command> commands{*node.next_command(), *node.next_command()};
    for (const int task : {1, 0}) {
      std::vector<std::uint32_t> frames = ScriptedNode::own_frames(commands[static_cast<std::size_t>(task)]);
      for (auto frame = frames.rbegin(); frame != frames.rend(); ++frame)
        node.send_strip(ScriptedNode::strip_of(commands[static_cast<std::size_t>(task)], *frame), 1000 + *frame);
    }
    EXPECT_FALSE(node.next_command());
  });
  EXPECT_EQ(run.sink.pixels, pixels_of(frames_to(4)));
}

// A frame in 40 strips with few credits.
TEST(Farm, CreditsComeBack) {
  const EmptyFilm film({2, 2});
  for (const std::int32_t credits : {1, 2, wire::kMaxCredits}) {
    ScriptedRun run;
    run.nodes = 2;
    run.work = {frames_to(4), true, 1};
    run.farm.credits = credits;
    run.buffers = 2;
    run.render(film, [credits] {
      ScriptedNode node(mynode() == 0);
      node.boot();
      EXPECT_EQ(node.load.credits, credits);
      while (const auto command = node.next_command())
        for (const std::uint32_t frame : ScriptedNode::own_frames(*command)) {
          for (std::uint32_t number = 0; number < 40; ++number) {
            wire::Strip strip = ScriptedNode::strip_of(*command, frame);
            strip.number = number;
            strip.last = number == 39;
            node.send_strip(strip, 1000 + frame);
          }
        }
      std::set<std::uint32_t> slots;
      for (const wire::Credit& credit : node.credits) EXPECT_TRUE(slots.insert(credit.slot).second);
      EXPECT_EQ(slots.size(), static_cast<std::size_t>(credits)) << "all are back when the host says stop";
    });
    EXPECT_EQ(run.sink.pixels, pixels_of(frames_to(4)));
  }
}

// Node 1 sends its keyframe's strips only when node 0 has used up its credits with inbetweens: these wait in the host.
TEST(Farm, StripsThatWaitHoldTheirCredits) {
  const EmptyFilm film({12});
  ScriptedRun run;
  run.nodes = 2;
  run.work = {frames_to(12), true, 1};
  run.farm.credits = 2;
  std::atomic<bool> used_up = false;
  run.render(film, [&] {
    ScriptedNode node;
    node.boot();
    const auto command = node.next_command();
    int sent = 0;
    for (const std::uint32_t frame : ScriptedNode::own_frames(*command)) {
      if (mynode() == 1 && frame == 0)
        while (!used_up) flick();
      if (mynode() == 0 && sent++ == 3) {  // its part of the keyframe, which is pasted at once, and two inbetweens
        EXPECT_TRUE(node.credits.empty());
        EXPECT_EQ(iprobe(wire::kCredit), 0) << "inbetweens wait for the keyframe of which a part is missing";
        used_up = true;
      }
      node.send_strip(ScriptedNode::strip_of(*command, frame), 1000 + frame);
    }
    EXPECT_FALSE(node.next_command());
  });
  EXPECT_EQ(run.sink.pixels, pixels_of(frames_to(12)));
}

TEST(Farm, ANodesFaultEndsTheRun) {
  const EmptyFilm film({4});
  ScriptedRun run;
  run.nodes = 3;
  run.work = {frames_to(4)};
  try {
    run.render(film, [] {
      ScriptedNode node;
      node.boot();
      node.next_command();
      if (mynode() == 2) {
        wire::Fault fault{};
        fault.node = 2;
        fault.frame = 3;
        std::memcpy(fault.reason.data(), "out of clay", 11);
        ScriptedNode::send(wire::kFault, fault);
      }
      ScriptedNode::receive(wire::kStop);
    });
    FAIL() << "nothing was thrown";
  } catch (const NodeFailure& failure) {
    EXPECT_EQ(failure.what(), std::string("node 2, frame 3: out of clay"));
    EXPECT_EQ(failure.node, 2);
    EXPECT_EQ(failure.frame, 3);
  }
}

// From a sink, from a listener, and while nobody answers at all.
TEST(Farm, CanBeCancelledFromWithinASink) {
  const EmptyFilm film(std::vector<std::uint32_t>(50, 4));
  Cancellation cancellation;
  ScriptedRun run;
  run.nodes = 3;
  run.work = {frames_to(200), true, 2};
  run.farm.cancellation = &cancellation;
  run.sink.taken = [&](std::uint32_t frame) {
    if (frame == 9) cancellation.cancel();
  };
  std::atomic<int> stopped = 0;
  const FarmReport report = run.render(film, [&] {
    sound_node();
    ++stopped;
  });
  EXPECT_TRUE(report.cancelled);
  EXPECT_LT(run.sink.pixels.size(), 200u);
  EXPECT_EQ(stopped, 3) << "Stop reached every node";
}

TEST(Farm, CancelledAfterTheLastFrameItIsNot) {
  const EmptyFilm film({4});
  Cancellation cancellation;
  ScriptedRun run;
  run.work = {frames_to(4)};
  run.farm.cancellation = &cancellation;
  run.listener.finished = [&](const FinishedFrame& frame) {
    if (run.sink.pixels.size() == 4 && frame.number == 3) cancellation.cancel();
  };
  EXPECT_FALSE(run.render(film, sound_node).cancelled);
}

TEST(Farm, CancelEndsTheWaitForANodeThatNeverAnswers) {
  const EmptyFilm film({4});
  // Never a greeting, never word of the film, never a strip.
  for (const int silent_after : {0, 1, 2}) {
    Cancellation cancellation;
    ScriptedRun run;
    run.nodes = 2;
    run.work = {frames_to(4)};
    run.farm.cancellation = &cancellation;
    std::thread canceller;
    const FarmReport report = run.render(film, [&] {
      ScriptedNode node;
      if (mynode() == 0 || silent_after > 1) {
        node.boot();
      } else if (silent_after == 1) {
        ScriptedNode::send(wire::kHello, ScriptedNode::hello());
        node.take_load();
      }
      if (mynode() == 1) canceller = std::thread([&] { cancellation.cancel(); });
      ScriptedNode::receive(wire::kStop);
    });
    canceller.join();
    EXPECT_TRUE(report.cancelled);
    EXPECT_TRUE(run.sink.pixels.empty());
  }
}

// In pieces, for messages have less than 2 GiB; once a machine.
TEST(Farm, TheFilmTravelsInPieces) {
  const EmptyFilm film({4}, 16, 8, 2 * wire::kFilmPiece);
  const std::size_t bytes = film.block().size();
  ScriptedRun run;
  run.nodes = 2;
  run.work = {{0}};
  run.render(film, [&] {
    ScriptedNode node;
    node.boot();
    EXPECT_EQ(node.load.film_bytes, bytes);
    EXPECT_EQ(node.film_pieces.size(), 3u);
    std::vector<std::byte> whole;
    for (const auto& piece : node.film_pieces) {
      EXPECT_LE(piece.size(), wire::kFilmPiece);
      whole.insert(whole.end(), piece.begin(), piece.end());
    }
    EXPECT_TRUE(std::equal(whole.begin(), whole.end(), film.block().begin(), film.block().end()));
    node.draw_all();
  });
}

}  // namespace
}  // namespace mars::farm
