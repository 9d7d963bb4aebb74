// Ranks as processes of one machine, over memory that they share (segment.h). A message is copied into a
// block of its sender, pushed to the receiver, copied out and given back; a rank that waits sleeps until it is
// woken, so a long wait costs nothing. A rank that dies leaves the memory sound: the job (job.h) sees it die and stops
// the segment, and every rank's next call throws the reason.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "hal/messages/backend.h"
#include "hal/processes/heap.h"
#include "hal/processes/segment.h"

namespace mars::processes {

class ProcessesBackend : public messages::Backend {
 public:
  // The rank whose slot is the `index`-th; `segment` outlives it. One a slot and time.
  ProcessesBackend(const Segment& segment, int index);
  ProcessesBackend(const Segment&&, auto&&...) = delete;

  int rank() const override { return id(index_); }
  int nodes() const override { return segment_.header().cube; }
  bool has_host() const override { return segment_.header().has_host; }
  void send(int to, int type, const void* data, std::size_t length) override;
  messages::Ticket start_send(int to, int type, const void* data, std::size_t length) override;
  bool sent(messages::Ticket) override { return true; }
  std::optional<messages::Envelope> peek() override;
  void take(void* buffer) override;
  void idle(int turn, std::chrono::microseconds longest) override;
  messages::Neighbourhood neighbourhood() override;
  std::shared_ptr<std::byte> share(std::size_t bytes) override;
  messages::Offer offer(std::size_t bytes) override;
  std::shared_ptr<std::byte> attach(int rank, const messages::MemoryName& name, std::size_t bytes) override;
  bool finish() override;
  [[noreturn]] void abort(const std::string& reason) override;

 private:
  // The host's id follows the nodes of the cube; its slot follows all nodes of the machine.
  int id(int index) const { return index == segment_.nodes() ? nodes() : index; }
  int index(int id) const { return id == nodes() ? segment_.nodes() : id; }

  void check_running() const;
  bool will_not_receive(const Slot& receiver) const;
  Offset first_seen();
  bool see_arrived();
  void release(int number, Offset begin, std::size_t bytes);

  const Segment& segment_;
  const int index_;
  Slot& slot_;
  const std::uint32_t ended_before_;  // the process that had this slot before
  Heap heap_;
  const bool oversubscribed_;
  Offset next_shared_;
  int shares_ = 0;  // so far
  bool finishing_ = false;
};

}  // namespace mars::processes
