// The host's beats and its nodes': while one lives the host says every few seconds that it lives, to nodes and to those
// who read its events, whatever it waits for, and watches that nodes do (node_watch.h). It looks after this whenever a
// message call waits and when it is asked to, never from a thread beside the host's: only the host's makes such calls.
// Where the machine is simulated it does nothing.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "host/render/farm/node_watch.h"
#include "node/wire/protocol.h"

namespace mars::farm {

// A node from which nothing has come for some seconds.
struct SilentNode {
  int node;
  std::string host;   // its machine
  int frame;          // that it draws; -1: none
  std::string doing;  // "scanline"
  double seconds;
};

// The frame that a node draws.
struct NodeFrame {
  int node;
  std::uint32_t frame;
};

// Called from the thread of the host.
struct HeartbeatListener {
  // Every two seconds: what the host does, and nodes that have been silent for five seconds or more.
  std::function<void(const std::string& doing, const std::vector<SilentNode>&)> beat;
  // Whether the host was asked to end, and how it does.
  std::function<bool()> asked_to_end;
  std::function<void(const std::vector<NodeFrame>& drawing)> end;
  // Whether a debugger has a process of the host's machine.
  std::function<bool(std::int32_t process)> is_traced;
};

class Heartbeats {
 public:
  // The calling HAL process is the host. `host`: its machine's name; `process`: its number there.
  Heartbeats(const std::string& host, std::int32_t process, HeartbeatListener listener);
  ~Heartbeats();
  Heartbeats(const Heartbeats&) = delete;
  Heartbeats& operator=(const Heartbeats&) = delete;

  void set_doing(const std::string& doing) { doing_ = doing; }
  // `work` takes long and makes no message calls: it is done in a thread of its own, and its exceptions are thrown
  // here.
  void during(const std::string& doing, const std::function<void()>& work);
  // Whenever the host's thread has been busy; mostly it is only a look at the clock. Throws NodeFailure for a node that
  // hangs.
  void look();

  // All nodes are there, and are watched from now on.
  void watch(std::span<const wire::Hello> hellos);
  // A strip came.
  void hear(const wire::Strip& strip);
  // The host has sent nodes the command to end: they need not hear the host, nor speak.
  void forget_nodes();
  // The frame that a node draws, by those that it was given and by the one that it said last it had begun; -1: none.
  using Drawing = std::function<std::optional<std::uint32_t>(int node, std::int32_t begun)>;
  // Who can say that; none: nodes draw nothing.
  void ask_for_drawing(Drawing drawing) { drawing_ = std::move(drawing); }

 private:
  std::vector<NodeFrame> drawing() const;
  void speak();
  void receive();
  void receive_beat();
  void report();
  void check_nodes() const;
  SilentNode silent(int node) const;
  int frame_of(int node) const;
  bool is_debugged(int node) const;
  std::string name_of(int node) const;

  const HeartbeatListener listener_;
  const bool has_machine_clock_;
  wire::Beat own_{};
  std::string doing_ = "loading";
  Drawing drawing_;
  std::vector<wire::Hello> hellos_;  // of nodes that are watched
  std::optional<NodeWatch> watch_;
  bool nodes_listen_ = true;
  double looked_;    // when
  double spoken_;    // when it beat last
  double reported_;  // when it reported last
};

}  // namespace mars::farm
