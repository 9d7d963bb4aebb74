// What bound a rendering that is over: its recorded times are played through again, without those of some walls. Nodes
// do their frames in the order in which they did, and wait for each other where they did; the host takes frames one by
// one; its sinks make files, as many at a time as there are threads; storage takes one file after another.
//
// The report knows the times of each node's steps, but only sums for the host, sinks and storage. So each frame gets a
// part of a sum: of the host's by the bytes that the host received, of others an equal one. Where nodes of a group wait
// for each other in a step, what a node spent there after the last had come is messages, the rest is waiting. Waiting
// for credit or storage is left out, as it follows from what the host and storage take. What the run took beyond all
// this is the host's: messages to it and from it.
#pragma once

#include <vector>

#include "host/render/farm/farm.h"
#include "host/render/walls/even.h"
#include "host/render/walls/walls.h"

namespace mars::report {

class Replay {
 public:
  // `report` outlives it, and has each frame.
  explicit Replay(const farm::FarmReport& report);
  explicit Replay(const farm::FarmReport&&) = delete;

  // Until the last frame was taken, without these walls.
  double seconds(walls::Walls without) const;
  // What took time.
  walls::Walls there() const;

 private:
  struct Part {
    std::size_t node;
    double before = 0;    // seconds of work until the group's sum
    double sum = 0;       // messages
    double exchange = 0;  // of triangles
    double drawing = 0;   // work after them
    double compose = 0;
    double still = 0;     // messages
    double bands = 0;     // messages
    bool waits = false;   // for lines and bands of others, as it draws inbetweens of the interval
    bool writes = false;  // the frame's file: it waits for all bands
  };
  struct Frame {
    std::uint32_t interval = 0;
    bool is_keyframe = false;
    std::vector<Part> parts;  // by node
    double host = 0;          // seconds of its loop
    double strips = 0;
  };
  struct Run;

  static Part part_of(const wire::Strip& strip);
  void find_waiting();
  void share_out_host();
  void separate_messages();
  template <typename Meet>
  static void draw(Run& run, const Frame& frame, const std::vector<walls::Pace>& paces, const Meet& meet);
  static double last_of(const Run& run, const Frame& frame);
  static bool waits(const Frame& frame, const Part& part, double Part::*step);
  double finish(Run& run) const;
  double played(walls::Walls without, const std::vector<walls::Pace>& paces, std::vector<walls::Busy>* busy) const;

  const farm::FarmReport& report_;
  std::vector<Frame> frames_;  // in an order in which nodes did them
  double making_ = 0;          // seconds of a sink, for a file
  double storing_ = 0;         // of storage, for a file
};

// In seconds of the report; none where it has no frames.
walls::Explanation explain(const farm::FarmReport& report);

}  // namespace mars::report
