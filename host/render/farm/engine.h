// The host's loop over nodes, whatever they draw. It shakes hands with them, sends them a film, hears them and stops
// them. A WorkGiver decides what nodes draw, a PictureTaker what becomes of it: of a film film_work.h and
// film_pictures.h, of a studio's views host/render/serve. Both say in the engine's Assignments what is to come.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hal/collectives/group.h"
#include "host/render/farm/assignments.h"
#include "host/render/farm/cancellation.h"
#include "host/render/farm/heartbeats.h"
#include "host/render/farm/node_inbox.h"
#include "host/render/farm/node_memory.h"
#include "host/render/farm/node_slots.h"
#include "host/render/farm/strip_message.h"
#include "host/render/farm/tracing.h"
#include "node/wire/protocol.h"

namespace mars::farm {

class WorkGiver {
 public:
  virtual ~WorkGiver() = default;
  // False: all is drawn, or nobody wants more.
  virtual bool goes_on() const = 0;
  // Gives nodes what there is to draw now; whether there was something.
  virtual bool give_work() = 0;
  // A strip is taken, or, where nodes write files, is in a file.
  virtual void note_taken(const wire::Strip&) {}
  // Nodes draw, or wait: there is nothing to do.
  virtual void rest();
};

class PictureTaker {
 public:
  virtual ~PictureTaker() = default;
  // Whether what came of a picture, which its node was given, can be: a strip, or, where nodes write files
  // (node/wire/frame_writer.h), word that the node's part `is_drawn`.
  virtual bool expects(const wire::Strip& strip, bool is_drawn) const = 0;
  // Such a strip. Its slot and memory go back to the engine once it is in its picture.
  virtual void take_strip(StripMessage strip) = 0;
  // Does a part of the work that what was taken makes; whether there was something.
  virtual bool compose() = 0;
  // As compose(), while no message has come.
  virtual bool prepare() { return false; }

  // Where nodes write files: such word; a frame's file is there, and whether it was asked for; a warning, for people.
  virtual void take_drawn(const wire::Strip&) {}
  virtual bool take_written(const wire::Written&) { return false; }
  virtual void warn(const std::string&) {}
};

struct EngineOptions {
  std::uint32_t width = 1, height = 1;  // of pictures, at most
  wire::PixelFormat format = wire::PixelFormat::rgb8;
  std::int32_t credits = wire::kMaxCredits;    // strips that a node may have on the way
  const Cancellation* cancellation = nullptr;  // none: nobody cancels
  Heartbeats* heartbeats = nullptr;            // none: nobody looks whether nodes live
  trace::Trace* trace = nullptr;               // to be filled; none: nothing is recorded
  bool watched = false;                        // as in Load
};

class Engine {
 public:
  // The calling HAL process is the host.
  explicit Engine(const EngineOptions& options);
  ~Engine();
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  // These wait for all nodes, and are false where they are cancelled before.

  // All nodes are there, and of the host's version.
  bool shake_hands();
  // All nodes have the film, and their slots. `load` says mapping, groups, memory and whether views are drawn; the rest
  // is added. `orders`: for nodes' frame writers, none where nodes have none. Nodes may have had another film before,
  // of which no strip is to come.
  bool load_film(std::span<const std::byte> block, wire::Load load, std::span<const std::byte> orders = {});

  // Until the giver ends or the run is cancelled. Throws Failure where a node fails; nodes then wait for commands.
  void run(WorkGiver& giver, PictureTaker& taker);
  // Sends Stop. `idle`: nodes have drawn all that they were given; else they send no more strips, and end when the
  // keyframes they were given are drawn.
  void stop(bool idle);

  // For those who give and take.

  Assignments& assignments() { return assignments_; }
  const NodeInbox& inbox() const { return inbox_; }
  Tracing& tracing() { return *tracing_; }
  StripStore& store() { return store_; }
  // A strip's slot is its node's again.
  void give(const NodeSlot& slot) { slots_.give(slot); }
  // A command to these nodes.
  static void send(const collectives::Group& nodes, long type, std::span<const std::byte> message);
  collectives::Group all() const { return {0, static_cast<int>(inbox_.hellos().size())}; }
  // Of a node, where none is asked for: that of the node with least.
  std::uint64_t node_memory() const;
  // Of a machine, at most.
  int nodes_together() const;
  bool has_layers() const { return wire::layers_of(options_.format) != 0; }
  void set_doing(const std::string& doing);

  double seconds() const;                                // since run() was called
  double busy_seconds() const { return busy_seconds_; }  // of those, in which the host took and composed strips

 private:
  bool cancelled() const { return options_.cancellation != nullptr && options_.cancellation->cancelled(); }
  bool hear(WorkGiver& giver, PictureTaker& taker);
  bool hear_strip(bool probed, WorkGiver& giver, PictureTaker& taker);
  void hear_drawn(WorkGiver& giver, PictureTaker& taker);
  void hear_written(PictureTaker& taker);
  void note_given(const wire::Strip& strip, bool is_drawn, const PictureTaker& taker);

  const EngineOptions options_;
  NodeSlots slots_;
  NodeInbox inbox_;
  Assignments assignments_;
  StripStore store_;
  std::optional<Tracing> tracing_;  // once all nodes are there
  double begun_ = 0;
  double busy_seconds_ = 0;
};

}  // namespace mars::farm
