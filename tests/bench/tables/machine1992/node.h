// A node of the 1992 program (thesis 4.8, 4.9): keyframes with all other nodes, inbetweens alone.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "node/geometry/scene.h"
#include "tests/bench/tables/machine1992/edge_lists.h"
#include "tests/bench/tables/machine1992/frame_buffers.h"
#include "tests/bench/tables/machine1992/record.h"
#include "tests/bench/tables/machine1992/scanlines.h"
#include "tests/bench/tables/machine1992/share.h"

namespace mars::machine1992 {

class Node {
 public:
  // The film outlives it and has one sample a pixel.
  explicit Node(const wire::PackedFilm& film);

  // The first frames of `interval`: its keyframe, then of as many inbetweens every numnodes()th.
  void draw_interval(std::uint32_t interval, std::uint32_t inbetweens);

  // Of each frame that it drew.
  const std::vector<NodeRecord>& records() const { return records_; }

 private:
  void draw_keyframe(std::uint32_t frame, bool moves);
  void draw_inbetween(std::uint32_t frame);

  void begin_record(std::uint32_t frame, bool keyframe);
  void make_lists();
  geometry::LineRange find_home();
  void exchange_boxes();
  void receive_boxes(int from);
  void draw_lines(const geometry::LineRange& lines);
  void exchange_depths();
  void send_strip(long type, bool moving, const geometry::LineRange& lines, const geometry::LineRange& columns);
  void spend_one(Work kind, std::uint64_t units);
  // The least lines, and columns as another range, on which the MFB has something.
  std::pair<geometry::LineRange, geometry::LineRange> moving_box();

  wire::PackedFilm film_;
  geometry::Scene scene_;
  Share share_;
  EdgeLists lists_;
  FrameBuffers buffers_;
  Scanlines scanlines_;
  std::vector<double> boxes_on_line_;       // of the node, then EBC of all
  std::vector<geometry::LineRange> homes_;  // of all nodes
  std::vector<std::vector<std::byte>> to_;  // edge boxes for each node
  std::vector<SentBox> own_;
  std::vector<NodeRecord> records_;
};

}  // namespace mars::machine1992
