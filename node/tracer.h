// Records what the calling node does and sends it to the host, while frames are drawn and at the end. One
// message is on its way at a time; meanwhile events gather, and what does not fit is counted (hal/messages/recorder.h).
#pragma once

#include "hal/messages/recorder.h"

namespace mars::node {

class Tracer {
 public:
  // Room for the messages of a pass among all nodes.
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
