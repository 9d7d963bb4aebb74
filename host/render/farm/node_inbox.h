// What nodes send, received and checked before anything of it is used: sizes against structs and counts, counts and
// ranges against the picture and the job. A node that sends what it must not is a NodeFailure that names it and its
// machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hal/failure/failure.h"
#include "hal/messages/recorder.h"
#include "host/render/farm/cancellation.h"
#include "host/render/farm/node_slots.h"
#include "host/render/farm/strip_message.h"
#include "host/render/farm/strip_receipts.h"
#include "node/wire/film.h"
#include "node/wire/protocol.h"

namespace mars::farm {

// A node cannot go on, or sends what makes no sense.
class NodeFailure : public Failure {
 public:
  // `frame` -1: before any.
  NodeFailure(const std::string& reason, int node, int frame);
  // `where` names the node and its machine.
  NodeFailure(const std::string& reason, const std::string& where, int node);
  // It has said nothing for `seconds`; `doing` is what it did, as it said last.
  static NodeFailure hangs(const std::string& where, const std::string& doing, int seconds, int node, int frame);

  int node;
  int frame;

 private:
  NodeFailure(const Failure& failure, int node, int frame) : Failure(failure), node(node), frame(frame) {}
};

// "n3 (node 17)"; `machine` "": it is not known.
std::string with_machine(const std::string& machine, int node);

// A node's beat; none: it makes no sense.
std::optional<wire::Beat> read_beat(std::span<const std::byte> message);

class NodeInbox {
 public:
  // Of all nodes of the job, for such pictures; `slots` are the nodes'. `cancellation` may be nullptr. `watched`: as in
  // Load.
  NodeInbox(std::uint32_t width, std::uint32_t height, wire::PixelFormat format, NodeSlots& slots,
            const Cancellation* cancellation, bool watched = false);

  // Waits until every node has greeted, and checks that all are of the host's own version. False: cancelled before.
  bool receive_hellos();
  const std::vector<wire::Hello>& hellos() const { return hellos_; }
  // A film is on its way to nodes; they may have had another before, of which no strip is to come.
  void expect_loaded() { loaded_.assign(loaded_.size(), false); }
  // Waits until every node has the film, and attaches their slots. False: cancelled before.
  bool wait_until_loaded();
  // Of the machines whose nodes do not share memory then, one text each.
  std::vector<std::string> apart() const;
  // Whether the node sees the folder into which it is to write.
  bool sees_folder(int node) const { return sees_folder_.at(static_cast<std::size_t>(node)); }
  // Waits for a message of this type; info* then describe it. A node's fault is thrown instead.
  void wait(long type) const;

  // Each receives a message that was probed last.

  // None: it is still on its way, and finished_strip has it when it has come. Its slot is the host's from then on.
  std::optional<StripMessage> receive_strip(StripStore& store);
  // The next strip of any node that has come since it was begun to be received; none: not yet.
  std::optional<StripMessage> finished_strip();
  // Of runs whose nodes write files. That the sender has drawn its part of a frame; its file; a warning, for people.
  wire::Strip receive_drawn() const;
  wire::Written receive_written() const;
  std::string receive_storage_warning() const;
  // The sender's events, valid until the next call.
  std::span<const messages::Event> receive_events();
  // Whether it has sent its last.
  bool events_ended(int node) const { return ended_.at(static_cast<std::size_t>(node)); }
  double receive_time(int node);
  [[noreturn]] void receive_fault() const;

  // "n3 (node 17)", as far as the node has greeted.
  std::string name_of(int node) const;
  [[noreturn]] void refuse(int node, const std::string& what) const;

 private:
  void require(bool holds, int node, const char* what) const;
  bool wait_unless_cancelled(long type) const;
  void receive_hello();
  void check_machines() const;
  void receive_loaded();
  void begin_message(int node, StripStore& store);
  std::optional<StripMessage> finished_message(int node);
  StripMessage checked(std::optional<StripMessage> strip, int node) const;
  std::optional<StripMessage> receive_by_slot(int node, StripStore& store);
  void take_slot(const wire::Strip& strip, int sender);
  void check_strip(const wire::Strip& strip, std::span<const wire::Run> runs, int sender) const;
  bool is_event(const messages::Event& event) const;

  const std::uint32_t width_;
  const std::uint32_t height_;
  const wire::PixelFormat format_;
  NodeSlots& slots_;
  const Cancellation* const cancellation_;
  const bool watched_;
  const int nodes_;
  StripReceipts receipts_;
  std::vector<wire::Hello> hellos_;
  std::vector<bool> is_known_;
  std::vector<bool> loaded_;
  std::vector<bool> sees_folder_;
  std::vector<std::string> apart_;  // why, as each node says
  std::vector<bool> ended_;         // its trace
  std::vector<messages::Event> events_;
};

}  // namespace mars::farm
