// Strips on their way to the host, made in the node's slots (protocol.h), with a credit for each. There are several, so
// that a node draws on while the host is busy.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hal/collectives/group.h"
#include "hal/messages/offered_memory.h"
#include "node/raster/strip_buffer.h"

namespace mars::group {

class Outbox {
 public:
  // For pixels of this format. All slots are the host's at first. `group`: the caller's. `watched`: as in Load.
  Outbox(wire::PixelFormat format, int slots, const collectives::Group& group, bool watched = false);

  const messages::MemoryName& slots() const { return memory_.name(); }

  // An empty strip of a picture of `width` in a slot of the node's; waits for credit where there is none, and counts
  // that in `work`. After Stop it waits for none: the host then uses no slot.
  raster::StripBuffer& begin(std::size_t width, bool constant, wire::WorkCounts& work);
  // Sends the strip that begin() gave, under `header`, to which its pixels and bytes are added. After Stop it
  // sends nothing: the host takes no more strips. `edge_boxes`: as in StripBuffer.
  void send(wire::Strip& header, std::span<const std::uint32_t> edge_boxes = {});
  bool stopped() const { return stopped_; }

  // Of a node that writes its frames itself: a strip in a slot of its own, for which no credit is needed; finished, it
  // lies there; the host learns that the frame is drawn.
  raster::StripBuffer& begin_own(std::size_t width, bool constant);
  std::span<const std::byte> finish_own(wire::Strip& header);
  void send_drawn(wire::Strip header);
  // Whether Stop or another Load has come; without waiting.
  void look_for_stop();

  // Receives one Credit message, waiting for it.
  void receive_credit();
  // What is gone by message, the caller needs no more.
  void discard_sent();
  // Waits until all is gone.
  void flush();

 private:
  struct Slot {
    std::uint32_t by_message = 0;
    long message = -1;  // -1: nothing on the way
  };

  void take_commands(wire::WorkCounts& work);
  void take_command();
  std::span<std::byte> memory_of(std::size_t slot) const;
  static void wait(Slot& slot);

  const std::size_t slot_bytes_;
  messages::OfferedMemory memory_;
  raster::StripBuffer strip_;  // in the making
  std::vector<Slot> slots_;
  const collectives::Group group_;
  std::uint32_t owned_ = 0;  // a bit for each slot that is the node's
  std::size_t current_ = 0;
  bool stopped_ = false;
};

}  // namespace mars::group
