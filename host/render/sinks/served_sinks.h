// Sinks of a host whose time is simulated: a sink takes a frame at once, and a server of the simulated machine says
// when it would have been done. Until then the frame's buffer is not free, as with threads.
#pragma once

#include <deque>
#include <functional>

#include "host/render/sinks/sink_pool.h"

namespace mars::sinks {

class ServedSinks : public SinkPool {
 public:
  // `serve`: when a frame that is submitted now, and takes that, will have been taken, in seconds of dclock().
  using Serve = std::function<double(const images::FileWork& work)>;

  ServedSinks(Sink& sink, const Shape& shape, Serve serve) : SinkPool(sink, shape, NoThreads()), serve_(serve) {}

  void submit(compositor::Frame* frame) override;
  std::vector<Taken> taken() override;
  void finish() override;

 private:
  struct Served {
    compositor::Frame* frame;
    Taken taken;
  };

  const Serve serve_;
  std::vector<Served> served_;  // whose end may be to come
};

}  // namespace mars::sinks
