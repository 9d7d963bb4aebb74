// Where finished frames go: files, later a screen or a studio. The sink pool knows only this class.
#pragma once

#include "host/images/file_work.h"
#include "host/render/compositor/frame.h"

namespace mars::sinks {

class Sink {
 public:
  virtual ~Sink() = default;
  // Called from several threads at once, each with a frame of its own, in any order of frames. Throws
  // Failure where the frame could not be taken.
  virtual void take(compositor::Frame& frame) = 0;
  // Whether it restores what it reads of a frame; else frames come without stale blocks.
  virtual bool restores() const { return false; }
  // Of all frames taken so far; from any thread.
  virtual images::FileWork made() const { return {}; }
  // Called now and then from another thread. Throws Failure where the sink has had frames for longer than it may.
  virtual void check() {}
  // Its frames are not wanted any more: those that wait within take() end as failures.
  virtual void give_up() {}
};

// Takes frames to nowhere, to measure what comes before.
class NullSink : public Sink {
 public:
  void take(compositor::Frame&) override {}
};

}  // namespace mars::sinks
