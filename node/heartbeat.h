// What tells the host that this node lives, and this node that its host does: Beat messages (node/wire/protocol.h).
// While one lives, the calling process's calls look after it whenever they wait; loops that compute for long do so
// themselves. Begins when the host's first beat comes; machines that are simulated have none.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "hal/failure/failure.h"
#include "node/node_identity.h"
#include "node/wire/protocol.h"

namespace mars::node {

// The host has not been heard for so long that it is taken for dead.
class HostLost : public Failure {
 public:
  HostLost();
};

class Heartbeat {
 public:
  explicit Heartbeat(const NodeIdentity& identity);
  ~Heartbeat();
  Heartbeat(const Heartbeat&) = delete;
  Heartbeat& operator=(const Heartbeat&) = delete;

  // What the node does: a frame, which the host learns at once, for the node may die of it; a step of it, or no frame,
  // for its next beats.
  void begin_frame(std::uint32_t frame);
  void enter(wire::Phase phase) { own_.phase = phase; }
  void rest() { own_.frame = -1; }
  // Called at each look, which is a chance to send what cannot wait; {}: nothing. Not where machines are simulated.
  void at_each_look(std::function<void()> call) { at_each_look_ = std::move(call); }

  // From loops that may take seconds, every millisecond or oftener: beats if it is time. It costs a look at the clock,
  // and mostly nothing where a loop's turns are short.
  void look() { look(false); }
  void look_now_and_then() {
    if (turns_++ % kTurnsALook == 0) look(false);
  }

 private:
  static constexpr unsigned kTurnsALook = 16;

  void look(bool waits);
  bool hear();
  void speak(bool waits);
  void send() const;
  bool host_is_debugged() const;

  const IsTraced is_traced_;
  const bool has_machine_clock_;
  std::function<void()> at_each_look_;
  wire::Beat own_{};
  wire::Beat host_{};
  bool begun_ = false;  // the host beats
  double looked_ = 0;   // when
  double spoken_ = 0;   // when it beat last
  double unheard_ = 0;  // seconds in which nothing came from the host, as far as the node ran in them
  unsigned turns_ = 0;
};

}  // namespace mars::node
