// Sinks of a host whose time is simulated: a sink takes a frame at once, and a server of the simulated machine says
// when it would have been done. Until then the frame's buffer is not free, as with threads.
#pragma once

#include <deque>
#include <functional>

#include "host/render/sinks/busy_time.h"
#include "host/render/sinks/sink_pool.h"

namespace mars::sinks {

class ServedSinks : public SinkPool {
 public:
  struct Times {
    double making = 0;  // seconds of a processor
    double made = 0;    // when it goes to storage, of dclock()
    double there = 0;   // when it will have been taken
  };
  // Of a frame that is submitted now, and takes that.
  using Serve = std::function<Times(const images::FileWork& work)>;

  ServedSinks(Sink& sink, const Shape& shape, Serve serve) : SinkPool(sink, shape, NoThreads()), serve_(serve) {}

  void submit(compositor::Frame* frame) override;
  std::vector<Taken> taken() override;
  images::FileWork made() const override;
  void finish() override;

 private:
  struct Served {
    compositor::Frame* frame;
    Taken taken;
  };

  const Serve serve_;
  std::vector<Served> served_;  // whose end may be to come
  double making_ = 0;           // seconds
  BusyTime storing_;
};

}  // namespace mars::sinks
