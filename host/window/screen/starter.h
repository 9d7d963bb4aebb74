// What started the window's program: it learns whether there is a display, and may leave the window to itself before it
// ends. If it ends otherwise, the program ends, at once: a thread waits for that, because a display that does not
// answer may hold up the others forever.
#pragma once

#include <atomic>
#include <string>
#include <thread>

#include "host/child/descriptor.h"

namespace mars::window {

class Starter {
 public:
  // Takes over kControl.
  Starter();
  ~Starter();
  Starter(const Starter&) = delete;
  Starter& operator=(const Starter&) = delete;

  // There is a display.
  void send_ready();
  // There is none.
  void explain(const std::string& problem, const std::string& remedy);

  bool has_left() const { return left_; }

 private:
  void wait_for_its_end();

  child::Descriptor control_;
  std::atomic<bool> left_{false}, ending_{false};
  std::thread thread_;
};

}  // namespace mars::window
