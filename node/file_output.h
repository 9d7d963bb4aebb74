// A film's frames as files that the node writes itself (wire/frame_writer.h), instead of strips for the host.
#pragma once

#include <cstdint>
#include <span>

#include "node/group/band_exchange.h"
#include "node/group/outbox.h"
#include "node/group/team_bands.h"
#include "node/heartbeat.h"
#include "node/raster/neighbours.h"
#include "node/wire/frame_writer.h"

namespace mars::node {

class FileOutput {
 public:
  // All outlive it. Collective over a machine's nodes.
  FileOutput(wire::FrameWriter& writer, const raster::Neighbours& neighbours, group::Outbox& outbox,
             Heartbeat& heartbeat);
  ~FileOutput() { heartbeat_.at_each_look({}); }
  FileOutput(const FileOutput&) = delete;
  FileOutput& operator=(const FileOutput&) = delete;

  wire::FrameWriter& writer() { return writer_; }
  // The strip of the current frame that the outbox has.
  void paste(wire::Strip& header);
  // Once all of a keyframe's home lines are pasted; the writer finishes its bands in between. As BandExchange.
  void exchange_edges(const group::BandNeeds& needs) { exchange_.exchange_edges(needs, writer_); }
  void exchange_bands(const group::BandNeeds& needs) { exchange_.complete(needs, writer_); }
  // Bands of an inbetween that a team draws; as TeamBands.
  group::TeamBands& team_bands() { return team_bands_; }
  // The frame is whole here: waits until its file can be written beside the drawing, unless the host has stopped.
  void write();
  // Files that are whole, and warnings, go to the host. Files also go at each look of the heartbeat: were the run ended
  // before, the host would not know that they are there.
  void report();

 private:
  void report_written();

  wire::FrameWriter& writer_;
  group::Outbox& outbox_;
  Heartbeat& heartbeat_;
  raster::NeighboursMemory shared_;
  group::BandExchange exchange_;
  group::TeamBands team_bands_;
};

}  // namespace mars::node
