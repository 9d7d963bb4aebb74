// Whether machines reach each other by TCP: each opens a door, a socket that listens, and all knock at all doors at the
// same time. Open MPI's daemons and ranks need the same.
#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "host/child/descriptor.h"

namespace mars::doctor {

// A machine and its door.
struct Peer {
  std::string host;
  std::uint16_t port = 0;
  std::vector<std::string> addresses;  // IPv4

  bool operator==(const Peer&) const = default;
};

class Door {
 public:
  // At a port that nobody uses. Throws Failure where the system gives none.
  explicit Door(const std::string& address = "0.0.0.0");
  ~Door();
  Door(const Door&) = delete;
  Door& operator=(const Door&) = delete;

  std::uint16_t port() const { return port_; }

 private:
  child::Descriptor socket_;
  std::uint16_t port_ = 0;
  std::jthread porter_;
};

// This machine's, on its networks; where it has none, 127.0.0.1.
std::vector<std::string> own_addresses();

// A machine that was reached at none of its addresses.
struct Missed {
  std::string from, to;
  std::string how;  // what became of the packets to its first address

  bool operator==(const Missed&) const = default;
};

// `from` knocks at all doors, at some at a time. `patience`: until packets that have no answer count as dropped. Where
// many are dropped, it gives up after a few times as long: those that were tried say enough.
std::vector<Missed> knock(const std::string& from, std::span<const Peer> peers, std::chrono::milliseconds patience);

}  // namespace mars::doctor
