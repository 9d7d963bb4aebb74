// Records the calling node's events and sends them to the host, while frames are drawn and at the end. One message is
// on its way at a time; meanwhile events gather, and those that do not fit are counted (hal/messages/recorder.h).
#pragma once

#include "hal/messages/recorder.h"

namespace mars::node {

class Tracer {
 public:
  // Has capacity for the events of one pass with all nodes.
  Tracer();

  // Sends what there is, unless the last message is still on its way.
  void send();
  // Sends the rest and waits until it is gone.
  void finish();

 private:
  void send_half(bool last);

  messages::Recorder recorder_;
  long message_ = -1;  // -1: nothing on the way
};

}  // namespace mars::node
