// Promise 4: the work is really divided, shown by counting what is sent and what each node says it did.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <memory>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include "node/group/mapping.h"
#include "node/wire/still_plan.h"
#include "tests/hal/machines_backend.h"
#include "tests/render/film_run.h"
#include "tests/render/films.h"
#include "tests/render/looks.h"
#include "tests/render/reference.h"

namespace mars::test {
namespace {

using wire::FrameKind;
using wire::Strip;

// Reads every strip that is sent, in its slot: whether its runs lie on the lines it speaks for. Adds up their bytes.
class StripReader : public messages::MachinesBackend {
 public:
  StripReader(messages::Backend& inner, messages::Counts& counts, messages::Machines& machines, std::uint64_t& bytes)
      : MachinesBackend(inner, counts, machines), bytes_(bytes) {}

  messages::Ticket start_send(int to, int type, const void* data, std::size_t length) override {
    if (type == wire::kStrip) bytes_ += read(static_cast<const std::byte*>(data));
    return messages::CountingBackend::start_send(to, type, data, length);
  }

 private:
  static std::size_t read(const std::byte* data) {
    Strip strip;
    std::memcpy(&strip, data, sizeof strip);
    const std::size_t runs_at = sizeof strip + strip.pixels * sizeof(std::uint32_t);
    const std::size_t end = runs_at + (strip.constant_runs + strip.moving_runs) * sizeof(wire::Run);
    for (std::size_t at = runs_at; at < end; at += sizeof(wire::Run)) {
      wire::Run run;
      std::memcpy(&run, data + at, sizeof run);
      EXPECT_TRUE(run.line >= strip.first_line && run.line < strip.last_line) << "node " << strip.node;
    }
    EXPECT_TRUE(strip.kind == FrameKind::keyframe || strip.constant_runs == 0) << "an inbetween sends no CFB";
    return end;
  }

  std::uint64_t& bytes_;
};

struct Counted {
  FilmRun run;
  messages::Counts counts;
  std::vector<std::uint64_t> strip_bytes;  // of each node
  std::size_t czb_written = 0;             // bytes, on all machines
};

struct Cluster {
  int nodes;
  int nodes_each = 1;  // of its machines
  std::uint32_t groups = 1;
  wire::Mapping mapping = wire::Mapping::greedy;
  std::int32_t sharers = 1;
  std::uint32_t most_frames = 0;
};

void run_counted(const wire::FilmData& film, const Cluster& cluster, Counted& out,
                 std::vector<std::uint32_t> frames = {}) {
  messages::Machines machines(cluster.nodes_each);
  RunOptions options;
  options.nodes = cluster.nodes;
  options.work.groups = cluster.groups;
  options.farm.mapping = cluster.mapping;
  options.work.sharers = cluster.sharers;
  options.work.most_frames = cluster.most_frames;
  options.work.frames = std::move(frames);
  out.strip_bytes.assign(static_cast<std::size_t>(cluster.nodes) + 1, 0);
  options.wrap = [&](messages::Backend& inner) {
    return std::make_unique<StripReader>(inner, out.counts, machines,
                                         out.strip_bytes[static_cast<std::size_t>(inner.rank())]);
  };
  out.run = run_film(FilmBlock(film).bytes(), options);
  out.czb_written = machines.written();
}

std::vector<Strip> of_kind(const Counted& counted, FrameKind kind) {
  std::vector<Strip> strips;
  for (const Strip& strip : counted.run.report.strips)
    if (strip.kind == kind) strips.push_back(strip);
  return strips;
}

struct Divided {
  int nodes;
  std::uint32_t samples;  // a pixel
};

void PrintTo(const Divided& divided, std::ostream* out) {
  *out << divided.nodes << " nodes, " << divided.samples << " samples";
}

class Division : public testing::TestWithParam<Divided> {
 protected:
  static constexpr std::uint32_t kFrames = 6;
  const wire::FilmData film_ = with_samples(crowd(320, 200, kFrames, kFrames), GetParam().samples);
};

// What a triangle has on one line of pixels: an edge box for each sub-scanline of which it covers samples.
struct OnLine {
  std::uint64_t edge_boxes = 0;
  std::uint64_t samples = 0;
};

// By line, by the plain twin; lines that the triangle does not touch are left out.
std::map<std::uint32_t, OnLine> count_on_lines(const raster::Corners& t, const wire::FilmSettings& film) {
  const shape::SamplePattern& pattern = shape::sample_pattern(film.samples);
  const auto [left, right] = std::minmax({t.x[0], t.x[1], t.x[2]});
  const auto [top, bottom] = std::minmax({t.y[0], t.y[1], t.y[2]});
  const auto first_of = [](std::int32_t place) { return std::max(place / 256 - 1, 0); };
  const auto last_of = [](std::int32_t place, std::uint32_t most) {
    return std::min(place / 256 + 1, static_cast<std::int32_t>(most));
  };
  std::map<std::uint32_t, OnLine> lines;
  for (std::int32_t line = first_of(top); line < last_of(bottom, film.height); ++line)
    for (int s = 0; s < pattern.count; ++s) {
      std::uint64_t covered = 0;
      for (std::int32_t column = first_of(left); column < last_of(right, film.width); ++column)
        covered += raster::covers_place(t, 256 * column + pattern.x[s], 256 * line + pattern.y[s]);
      if (covered == 0) continue;
      OnLine& here = lines[static_cast<std::uint32_t>(line)];
      ++here.edge_boxes;
      here.samples += covered;
    }
  return lines;
}

TEST_P(Division, EachNodeDicesItsOwnPatchesInAKeyframe) {
  const int nodes = GetParam().nodes;
  Counted alone, divided;
  run_counted(film_, {1}, alone, {0});
  run_counted(film_, {nodes}, divided, {0});
  const Strip whole = alone.run.report.strips.front();
  const std::uint64_t share = (FilmBlock(film_).view().patch_instances() + nodes - 1) / nodes;
  std::uint64_t patches = 0, triangles = 0, vertices = 0;
  for (const Strip& strip : divided.run.report.strips) {
    EXPECT_LE(strip.work.patches, share);
    patches += strip.work.patches;
    triangles += strip.work.triangles;
    vertices += strip.work.vertices;
  }
  EXPECT_EQ(patches, whole.work.patches);
  EXPECT_EQ(triangles, whole.work.triangles);
  EXPECT_EQ(vertices, whole.work.vertices);
}

TEST_P(Division, EachNodeTouchesItsOwnLines) {
  Counted counted;
  run_counted(film_, {GetParam().nodes}, counted);
  std::map<std::int32_t, Strip> by_node;
  for (const Strip& strip : of_kind(counted, FrameKind::keyframe)) by_node[strip.node] = strip;
  ASSERT_EQ(by_node.size(), static_cast<std::size_t>(GetParam().nodes));
  std::uint32_t next = 0;
  for (const auto& [node, strip] : by_node) {
    EXPECT_EQ(strip.first_line, next) << "lines tile the picture in order of nodes";
    next = strip.last_line;
  }
  EXPECT_EQ(next, film_.settings.height);
}

TEST_P(Division, EdgeBoxesBeforeAndAfterTheExchangeAreEbcsLast) {
  Counted counted;
  run_counted(film_, {GetParam().nodes}, counted, {0});
  std::uint64_t before = 0, after = 0, most = 0;
  for (const Strip& strip : counted.run.report.strips) {
    before += strip.work.edge_boxes_diced;
    after += strip.work.edge_boxes;
    most = std::max(most, strip.work.edge_boxes);
  }
  const Strip& any = counted.run.report.strips.front();
  EXPECT_GT(any.edge_box_total, 0u);
  EXPECT_EQ(before, any.edge_box_total);
  EXPECT_EQ(after, any.edge_box_total);
  EXPECT_NEAR(any.load_ratio, static_cast<double>(most) * GetParam().nodes / static_cast<double>(after), 1e-9);
  EXPECT_LT(any.load_ratio, 1.5) << "the load is about even";
}

// By the plain twin.
TEST_P(Division, SamplesAreThoseThatEdgeBoxesCover) {
  Counted counted;
  run_counted(film_, {GetParam().nodes}, counted, {0});
  std::vector<std::uint64_t> samples(film_.settings.height);
  for (const raster::PlainTriangle& t : draw_reference(FilmBlock(film_).view(), 0).triangles)
    for (const auto& [line, here] : count_on_lines(t.corners, film_.settings)) samples[line] += here.samples;
  for (const Strip& strip : counted.run.report.strips)
    EXPECT_EQ(strip.work.samples,
              std::accumulate(samples.begin() + strip.first_line, samples.begin() + strip.last_line, std::uint64_t{0}));
}

std::size_t whole_cache_lines(std::size_t bytes) { return (bytes + 63) / 64 * 64; }

// What nodes of several machines give each other, by the plain twin: a triangle goes once to each node of another
// machine that is a home of its lines, with its boxes there and no others, and no message is empty.
TEST_P(Division, TrianglesTravelOnceToEachHomeOfTheirLines) {
  const int nodes = GetParam().nodes;
  for (const int nodes_each : {1, 2, 3}) {
    Counted counted;
    run_counted(film_, {nodes, nodes_each}, counted, {0});
    std::vector<Strip> homes(static_cast<std::size_t>(nodes));
    for (const Strip& strip : counted.run.report.strips) homes.at(static_cast<std::size_t>(strip.node)) = strip;
    const Reference reference = draw_reference(FilmBlock(film_).view(), 0);
    std::map<std::pair<int, int>, std::uint64_t> triangles, boxes;
    for (const raster::PlainTriangle& t : reference.triangles) {
      const auto lines = count_on_lines(t.corners, film_.settings);
      const int from = static_cast<int>(t.record.patch) % nodes;
      for (int to = 0; to < nodes; ++to) {
        const Strip& home = homes[static_cast<std::size_t>(to)];
        std::uint64_t there = 0;
        for (const auto& [line, here] : lines)
          if (line >= home.first_line && line < home.last_line) there += here.edge_boxes;
        boxes[{from, to}] += there;
        triangles[{from, to}] += there > 0;
      }
    }
    std::uint64_t most = 0;
    for (int from = 0; from < nodes; ++from)
      for (int to = 0; to < nodes; ++to) {
        const auto sent = counted.counts.sent({.from = from, .to = to, .type = wire::kTriangles});
        const auto expected = triangles[{from, to}], expected_boxes = boxes[{from, to}];
        const bool travels = from / nodes_each != to / nodes_each && expected > 0;
        EXPECT_EQ(sent.messages, travels ? 1u : 0u) << from << " to " << to << ", " << nodes_each << " a machine";
        const std::size_t head = whole_cache_lines(sizeof(wire::TriangleHead));
        EXPECT_EQ(sent.bytes, travels ? whole_cache_lines(head + expected_boxes * sizeof(raster::UnsortedEdgeBox)) +
                                            expected * sizeof(geometry::Triangle)
                                      : 0)
            << from << " to " << to << ", " << nodes_each << " a machine";
        if (travels) most = std::max(most, expected);
      }
    EXPECT_TRUE(nodes <= nodes_each || most > 100);
  }
}

TEST(Division, NoMessageIsEmptyBetweenMachines) {
  Counted counted;
  run_counted(crowd(320, 200, 6, 3), {8}, counted);
  for (const int type : {wire::kTriangles, wire::kStillLines}) {
    EXPECT_GT(counted.counts.sent({.type = type}).messages, 10u) << type;
    EXPECT_EQ(counted.counts.sent({.type = type}).empty, 0u) << type;
  }
}

TEST_P(Division, InbetweensSendNothingToNodesAndDrawNothingStationary) {
  const int nodes = GetParam().nodes;
  Counted counted, keyframe;
  run_counted(film_, {nodes}, counted);
  std::uint64_t moving_patches = 0;
  for (const std::uint32_t s : film_.moving) moving_patches += film_.shapes[film_.segments[s].shape].size();
  std::set<std::int32_t> contributors;
  const auto inbetweens = of_kind(counted, FrameKind::inbetween);
  EXPECT_EQ(inbetweens.size(), kFrames - 1u);
  for (const Strip& strip : inbetweens) {
    EXPECT_EQ(strip.work.bytes_to_nodes, 0u);
    EXPECT_GT(strip.work.patches, 0u);
    EXPECT_LE(strip.work.patches, moving_patches);
    contributors.insert(strip.node);
  }
  EXPECT_EQ(contributors.size(), std::min<std::size_t>(nodes, kFrames - 1)) << "round robin";
  // All triangles that nodes gave each other are the keyframe's: one message at most for each pair.
  EXPECT_LE(counted.counts.sent({.type = wire::kTriangles}).messages, static_cast<std::uint64_t>(nodes * (nodes - 1)));
}

// Whether the net's or the vertices' points of one of the segment's pieces follow a bone that moves, plainly.
bool follows_moving(const wire::PackedFilm& film, std::uint32_t segment, std::size_t piece) {
  const wire::Segment& of = film.segments()[segment];
  const auto moving = film.moving(film.intervals()[0]);
  bool follows = false;
  const auto look = [&](const wire::Skin& skin, std::uint32_t points) {
    for (std::size_t i = 0; i < skin.bone_count; ++i)
      for (const float weight : film.weights_of(skin, points).subspan(i * points, points))
        follows |= weight > 0 &&
                   std::ranges::count(moving, film.segments().size() + of.first_bone + film.bones_of(skin)[i]) > 0;
  };
  const std::size_t patches = film.shape(of.shape).patch_count;
  if (piece >= patches) {
    const wire::Meshlet& meshlet = film.meshlets_of(of.shape)[piece - patches];
    look(meshlet.skin, meshlet.vertex_count);
    return follows;
  }
  for (const std::uint32_t stencil : film.net_patches_of(of.shape)[piece].stencils)
    for (const wire::StencilTerm& term : film.terms_of(film.stencils()[stencil]))
      look(film.net_points()[term.point].skin, 1);
  return follows;
}

TEST(Division, OfSkinsInbetweensDrawWhatFollowsBonesThatMove) {
  const wire::FilmData data = bending(240, 160, 5, 5);
  const FilmBlock block(data);
  const wire::PackedFilm film = block.view();
  std::uint64_t moving = 0, all = 0;
  for (const std::uint32_t segment : film.moving_segments(film.intervals()[0]))
    for (std::size_t piece = 0; piece < film.shape(film.segments()[segment].shape).size(); ++piece, ++all)
      moving += follows_moving(film, segment, piece);
  ASSERT_LT(moving, all);
  Counted counted;
  run_counted(data, {1}, counted);
  const auto inbetweens = of_kind(counted, FrameKind::inbetween);
  ASSERT_EQ(inbetweens.size(), 4u);
  for (const Strip& strip : inbetweens) EXPECT_EQ(strip.work.patches, moving) << "all are seen";
}

// Each node draws its own lines, and makes what touches them: no edge box twice, few patches twice, without a message.
TEST_P(Division, NodesThatShareAnInbetweenDivideIt) {
  const int nodes = GetParam().nodes;
  Counted alone, shared;
  run_counted(film_, {1}, alone);
  run_counted(film_, {.nodes = nodes, .sharers = nodes}, shared);
  std::map<std::uint32_t, Strip> whole;
  for (const Strip& strip : of_kind(alone, FrameKind::inbetween)) whole[strip.frame] = strip;
  std::map<std::uint32_t, std::map<std::int32_t, Strip>> parts;
  for (const Strip& strip : of_kind(shared, FrameKind::inbetween)) parts[strip.frame][strip.node] = strip;
  ASSERT_EQ(parts.size(), kFrames - 1u);
  std::uint64_t patches_alone = 0, patches = 0, most_patches = 0, boxes_alone = 0, most_boxes = 0;
  for (const auto& [frame, of_nodes] : parts) {
    ASSERT_EQ(of_nodes.size(), static_cast<std::size_t>(nodes));
    std::uint32_t next = 0;
    std::uint64_t edge_boxes = 0, diced = 0, pixels = 0, frame_patches = 0, frame_most = 0, boxes_most = 0;
    for (const auto& [node, strip] : of_nodes) {
      EXPECT_EQ(strip.first_line, next) << "lines tile the picture in order of nodes";
      next = strip.last_line;
      edge_boxes += strip.work.edge_boxes;
      diced += strip.work.edge_boxes_diced;
      pixels += strip.work.pixels;
      frame_patches += strip.work.patches;
      frame_most = std::max(frame_most, strip.work.patches);
      boxes_most = std::max(boxes_most, strip.work.edge_boxes);
      EXPECT_EQ(strip.work.bytes_to_nodes, 0u);
    }
    EXPECT_EQ(next, film_.settings.height);
    EXPECT_EQ(edge_boxes, whole[frame].work.edge_boxes);
    EXPECT_EQ(diced, whole[frame].work.edge_boxes_diced) << "of others' lines none";
    EXPECT_EQ(pixels, whole[frame].work.pixels);
    patches_alone += whole[frame].work.patches, patches += frame_patches, most_patches += frame_most;
    boxes_alone += whole[frame].work.edge_boxes, most_boxes += boxes_most;
  }
  EXPECT_GE(patches, patches_alone);
  EXPECT_EQ(shared.counts.sent({.type = wire::kBands}).messages, 0u) << "the host writes";
  if (nodes == 1) return;
  EXPECT_LT(most_patches, patches_alone) << "dicing is divided";
  EXPECT_LT(most_boxes, boxes_alone * 3 / 4) << "the load is divided, too";
}

// The first frame of each piece is drawn as a keyframe, others as inbetweens: as often as all must be.
TEST_P(Division, PiecesOfAnIntervalAreTasksOfTheirOwn) {
  Counted counted;
  run_counted(film_, {.nodes = GetParam().nodes, .most_frames = 4}, counted);
  std::set<std::uint32_t> keyframes, inbetweens;
  for (const Strip& strip : of_kind(counted, FrameKind::keyframe)) keyframes.insert(strip.frame);
  for (const Strip& strip : of_kind(counted, FrameKind::inbetween)) inbetweens.insert(strip.frame);
  EXPECT_EQ(keyframes, (std::set<std::uint32_t>{0, 3}));
  EXPECT_EQ(inbetweens, (std::set<std::uint32_t>{1, 2, 4, 5}));
}

TEST_P(Division, BytesReportedAreBytesSent) {
  const int nodes = GetParam().nodes;
  for (const int nodes_each : {1, 2, nodes}) {
    Counted loading;  // groups of one node give each other nothing but what loading the film takes
    run_counted(film_, {nodes, nodes_each, static_cast<std::uint32_t>(nodes)}, loading, {0});
    Counted counted;
    run_counted(film_, {nodes, nodes_each}, counted);
    for (int from = 0; from < nodes; ++from) {
      std::uint64_t to_nodes = 0, to_host = 0, sent = 0;
      for (const Strip& strip : counted.run.report.strips)
        if (strip.node == from) {
          to_nodes += strip.work.bytes_to_nodes;
          to_host += strip.work.bytes_to_host;
        }
      for (int to = 0; to < nodes; ++to) {
        sent += counted.counts.sent({.from = from, .to = to, .type = {}}).bytes;
        sent -= loading.counts.sent({.from = from, .to = to, .type = {}}).bytes;
      }
      EXPECT_EQ(to_nodes, sent) << "node " << from << ", " << nodes_each << " a machine";
      EXPECT_EQ(to_host, counted.strip_bytes[static_cast<std::size_t>(from)]) << "node " << from;
      // On the host's machine, the first, only headers travel.
      const auto strips = counted.counts.sent({.from = from, .to = nodes, .type = wire::kStrip});
      EXPECT_EQ(strips.bytes, from < nodes_each ? strips.messages * sizeof(Strip) : to_host) << "node " << from;
    }
  }
}

// The arena holds what docs/floors.md says, at its peak, and little more.
TEST_P(Division, MemoryIsAsTheFormulaSays) {
  const int nodes = GetParam().nodes;
  for (const int nodes_each : {1, nodes}) {
    Counted counted;
    run_counted(film_, {nodes, nodes_each}, counted, {0});
    const std::uint64_t received = counted.counts.sent({.type = wire::kTriangles}).bytes;  // by all
    for (const Strip& strip : counted.run.report.strips) {
      const auto& work = strip.work;
      const bool travels = nodes_each < nodes;
      const std::uint64_t own = 64 * work.triangles + (12 + 8) * work.edge_boxes_diced;
      // A triangle is reserved with each edge box that may be sent; what comes is part of what all send.
      const std::uint64_t sent = travels ? (64 + 12) * work.edge_boxes_diced : 0;
      const std::uint64_t in_lines = travels ? 8 * work.edge_boxes : 0;
      const std::uint64_t small = 64 * film_.settings.height + 512 * static_cast<std::uint64_t>(nodes) + 4096;
      EXPECT_GE(work.memory, own);
      EXPECT_LE(work.memory, own + sent + received + in_lines + small) << nodes_each << " a machine";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Nodes, Division,
                         testing::Values(Divided{1, 1}, Divided{2, 1}, Divided{3, 1}, Divided{5, 1}, Divided{8, 1},
                                         Divided{1, 4}, Divided{3, 4}, Divided{8, 4}, Divided{5, 16}));

// As many tasks as groups: none gets two while another has none.
TEST(Division, EveryGroupGetsATask) {
  const FilmBlock film(crowd(64, 40, 4, 1));
  RunOptions options;
  options.nodes = 4;
  options.work.groups = 4;
  std::set<std::int32_t> contributors;
  for (const wire::Strip& strip : run_film(film.bytes(), options).report.strips) contributors.insert(strip.node);
  EXPECT_EQ(contributors.size(), 4u);
}

// A few wide edge boxes a line above, many narrow ones below.
wire::FilmData wide_and_narrow() {
  FilmMaker maker(320, 200, 1);
  const std::uint32_t material = maker.add_material(kClay), box = maker.add_shape(crowd(8, 8, 1, 1).patches);
  maker.add_segment(box, material, {placed({-3, 0, 0.2}, 6)});
  for (int i = 0; i < 60; ++i)
    maker.add_segment(box, material, {placed({-3.0 + 0.2 * (i % 30), 0, -0.5 - 0.6 * (i / 30)}, 0.3)});
  maker.set_cameras({looking({0, -9, 0}, {0, 0, 0}, 40)});
  return maker.make();
}

// The greatest work of a node, weighted as its lines are.
std::uint64_t greatest_cost(const wire::FilmData& film, int nodes, wire::Mapping mapping) {
  Counted counted;
  run_counted(film, {nodes, 1, 1, mapping}, counted);
  std::uint64_t greatest = 0, all = 0;
  for (const Strip& strip : counted.run.report.strips) {
    const std::uint64_t cost = group::line_cost({strip.work.edge_boxes, strip.work.samples});
    greatest = std::max(greatest, cost);
    all += cost;
  }
  if (mapping == wire::Mapping::cost) {
    EXPECT_NEAR(counted.run.report.strips.front().load_ratio,
                static_cast<double>(greatest) * nodes / static_cast<double>(all), 1e-9);
  }
  return greatest;
}

TEST(Division, CostMakesTheWorkEvenWhereBoxesDoNot) {
  const wire::FilmData film = wide_and_narrow();
  for (const int nodes : {2, 3, 4}) {
    const std::uint64_t greedy = greatest_cost(film, nodes, wire::Mapping::greedy);
    EXPECT_LT(greatest_cost(film, nodes, wire::Mapping::cost), greedy * 9 / 10) << nodes << " nodes";
  }
}

// CZB lines travel only where moving parts can be seen, once to each machine with nodes that draw inbetweens; on one
// machine not at all.
TEST(Division, DepthGoesOnlyWhereItIsNeeded) {
  FilmMaker maker(200, 200, 2);
  const std::uint32_t material = maker.add_material(kClay);
  const std::uint32_t box = maker.add_shape(crowd(8, 8, 1, 1).patches);
  maker.add_segment(box, material, {placed({-2, -2, -2}, 4)});
  maker.add_segment(box, material, {placed({-0.2, -4, -1.4}, 0.4), placed({0, -4, -1.4}, 0.4)});
  maker.set_cameras({looking({0, -9, 0}, {0, 0, 0}, 40)});
  const wire::FilmData film = maker.make();
  std::map<int, std::uint64_t> bytes, written;  // by nodes a machine
  for (const int nodes_each : {1, 2, 4}) {
    Counted counted;
    run_counted(film, {4, nodes_each}, counted);
    for (int from = 0; from < 4; ++from) {
      const auto sent = counted.counts.sent({.from = from, .type = wire::kStillLines});
      bytes[nodes_each] += sent.bytes;
      EXPECT_LE(sent.messages, 1u) << "only one node draws the one inbetween";
    }
    written[nodes_each] = counted.czb_written;
  }
  EXPECT_GT(bytes[1], 0u);
  EXPECT_LT(bytes[1], 200u * 200 * sizeof(float) / 3) << "the mover passes over less than a third of the lines";
  EXPECT_LE(bytes[2], bytes[1]);
  EXPECT_EQ(bytes[4], 0u);
  EXPECT_GT(written[4], 0u);
  EXPECT_LT(written[4], 200u * 200 * sizeof(float) / 3) << "and no other line of a machine's CZB is touched";
}

// And of kept lines only columns: of a picture of which moving parts and their shadows change a corner.
TEST(Division, OfLinesOnlyWhatMayChangeIsKeptAndSent) {
  const wire::FilmData alone = corner(320, 240, 4);
  for (const wire::FilmData& film : {alone, with_samples(alone, 4), casting(alone, {0.0f}), casting(alone, {0.02f}),
                                     casting(with_samples(alone, 4), {0.0f})}) {
    const auto casts = static_cast<std::uint32_t>(film.lights.front().casts);
    const std::uint32_t samples = film.settings.samples;
    const wire::StillPlan plan = wire::plan_still_lines(320, 240, samples, std::uint64_t{1} << 40, casts);
    const std::uint64_t all =  // with a group a pixel
        240 * (plan.line_bytes - 320 * wire::still_group_bytes(casts) * (std::max(plan.groups_per_column, 1u) - 1));
    SCOPED_TRACE(testing::Message() << samples << " samples, " << casts << " lights cast");
    Counted counted;
    run_counted(film, {2, 1}, counted);
    const std::uint64_t bytes = counted.counts.sent({.type = wire::kStillLines}).bytes;
    EXPECT_GT(bytes, 0u);
    EXPECT_LT(bytes, all / 15);
  }
}

}  // namespace
}  // namespace mars::test
