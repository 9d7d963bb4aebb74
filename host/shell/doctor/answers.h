// What the machines of a rendering answer to the doctor that asks them, each a line of JSON, and what it comes to:
// findings about all machines together, which name machines.
//
// A machine first answers what it is, with its findings. Then it is given everybody's door, answers at once with its
// clock, and later which doors it did not reach.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/shell/doctor/meeting.h"
#include "host/shell/doctor/show.h"

namespace mars::doctor {

using SystemTime = std::chrono::system_clock::time_point;

struct Presence {
  Peer peer;
  std::string build;         // of MARS: its version, and a checksum of mars-node
  std::uint64_t memory = 0;  // bytes; 0: unknown
  bool sees_folder = false;  // the file is there that the asking doctor wrote into the folder
};

// What one machine has answered so far.
struct MachineAnswer {
  Presence presence;
  std::optional<double> ahead;  // seconds that its clock is ahead of ours at least; negative: behind
  std::optional<std::vector<Missed>> missed;
};

std::string line_of(const Presence& presence);
std::string clock_line(const std::string& host, SystemTime now);
std::string line_of(const std::string& host, std::span<const Missed> missed);
std::string line_of(std::span<const Peer> peers);
// None where the line is no list of doors.
std::optional<std::vector<Peer>> read_peers(const std::string& line);

class Answers {
 public:
  // False: the line is none of a machine's.
  bool take(const std::string& line, SystemTime now);
  // All machines are given everybody's door from now on.
  void doors_are_sent(SystemTime now) { sent_ = now; }

  bool is_present(const std::string& host) const { return find(host) != nullptr; }
  bool has_met(const std::string& host) const { return find(host) != nullptr && find(host)->missed; }
  std::vector<Peer> peers() const;
  std::span<const MachineAnswer> machines() const { return machines_; }
  std::span<const MachineFindings> findings() const { return findings_; }

 private:
  const MachineAnswer* find(const std::string& host) const;

  std::vector<MachineAnswer> machines_;
  std::vector<MachineFindings> findings_;
  SystemTime sent_;
};

// Those that do not reach each other: "n1,n2,n4 cannot reach n3 by TCP: packets are dropped, by a firewall?"; none: all
// do.
std::vector<std::string> who_cannot_reach(std::span<const MachineAnswer> machines);

// `folder`: which all should see; "": nothing could be written there.
std::vector<Finding> check_together(const Answers& answers, const std::string& folder);

// About machines that did not answer, by the last words of the command that asked them. `self`: MARS's program there.
Finding check_silence(const std::vector<std::string>& hosts, const std::string& words, const std::string& self);

}  // namespace mars::doctor
