// Strips on their way to the host, a buffer for each credit. Credits are the number of strips that may be on their way,
// so that a node draws on while the host is busy.
#pragma once

#include <cstddef>
#include <vector>

#include "node/raster/strip_buffer.h"

namespace mars::group {

class Outbox {
 public:
  // `width`: of the picture; `credits`: at the start, and at most.
  Outbox(std::size_t width, int credits);

  // An empty buffer (StripBuffer::clear); waits until the strip last sent from it is gone.
  raster::StripBuffer& begin(bool constant);
  // Sends the buffer that begin() gave under `header`, waiting for credit first; the wait, pixels and bytes are added
  // to `header`. After Stop it sends nothing: the host takes no more strips.
  void send(wire::Strip& header);
  bool stopped() const { return stopped_; }

  // Receives one Credit message, waiting for it.
  void receive_credit();
  // Waits until all is gone.
  void flush();

 private:
  struct Slot {
    raster::StripBuffer buffer;
    long message = -1;  // -1: nothing on the way
  };

  void wait_for_credit(wire::Strip& header);
  void take_command();
  static void wait(Slot& slot);

  std::vector<Slot> slots_;
  std::size_t current_ = 0;
  int credits_;
  bool stopped_ = false;
};

}  // namespace mars::group
