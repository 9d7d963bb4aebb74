// One node's part in a collective by dimension exchange: the hypercube that the nodes of a group form, and
// the messages across it. Positions are node ids less the group's first. The lowest 2^d of them are the
// corners; each other one folds in with the corner 2^d below it. An error found on one node reaches all,
// and none is left waiting: messages go on, spoilt ones among them, and at the end all nodes fail.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "hal/collectives/group.h"

namespace mars::messages {
class Process;
}

namespace mars::collectives {

class DimensionExchange {
 public:
  // For a call of that name on the calling thread's process; fails on the host.
  DimensionExchange(const char* call, const Group& group);

  int position() const { return position_; }
  int count() const { return group_.count; }
  int corners() const { return corners_; }
  bool folded() const { return position_ >= corners_; }               // has a partner below
  bool folds() const { return position_ + corners_ < group_.count; }  // has a partner above

  // One message of exactly `bytes` bytes. A receive is there for each send, of the same length.
  void send(int to, const void* data, std::size_t bytes);
  void receive(int from, void* data, std::size_t bytes);
  // One each way; `out` and `in` do not overlap.
  void swap_with(int partner, const void* out, std::size_t out_bytes, void* in, std::size_t in_bytes);

  // Notes an error; the first counts. Messages sent from now on say that there is one. `code` is a CallError.
  void spoil(int code, const std::string& what, const std::string& remedy);
  bool spoilt() const { return fault_.has_value(); }
  // At the end: throws this process's CallFailure if something was wrong on any node.
  void conclude() const {
    if (fault_) fail();
  }

 private:
  struct Fault {
    int code;
    std::string what;
    std::string remedy;
  };

  std::size_t spoilt_length(std::size_t bytes) const;
  void check_came(int from, std::size_t came, std::size_t bytes);
  [[noreturn]] void fail() const;

  const char* call_;
  messages::Process& process_;
  Group group_;
  int position_ = 0;
  int corners_ = 1;
  std::optional<Fault> fault_;
};

}  // namespace mars::collectives
