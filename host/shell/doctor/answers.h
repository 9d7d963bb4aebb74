// The answers of machines to the doctor that asks them, and what they come to: findings that name machines.
//
// A machine answers with its findings and its door. Then it is given all doors, and answers at once with its clock,
// then with the doors that it missed, and that it has met all others. An answer is a line.
#pragma once

#include <chrono>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "host/shell/doctor/meeting.h"
#include "host/shell/doctor/show.h"

namespace mars::doctor {

using SystemTime = std::chrono::system_clock::time_point;

std::string door_line(const Peer& peer);
std::string clock_line(const std::string& host, SystemTime now);
std::string missed_line(const Missed& missed);
std::string met_line(const std::string& host);

// All doors, as machines are given them.
std::string doors_line(std::span<const Peer> peers);
std::vector<Peer> read_doors(const std::string& line);

struct Answers {
  std::vector<MachineFindings> findings;
  std::vector<Peer> doors;              // of machines that have answered
  SystemTime given;                     // when all doors were given to all
  std::map<std::string, double> ahead;  // seconds that a machine's clock is ahead of ours at least; negative: behind
  std::vector<Missed> missed;
  std::set<std::string> met;  // machines that have met all others

  // False: the line is no answer.
  bool take(const std::string& line, SystemTime now);
  bool has_door(const std::string& host) const;
};

// "n1,n2,n4 cannot reach n3 by TCP: packets are dropped, by a firewall?"; none: all reach each other.
std::vector<std::string> who_cannot_reach(std::span<const Missed> missed);

std::vector<Finding> check_together(const Answers& answers);

// About machines that did not answer, by the last words of the command that asked them. `self`: MARS's program there.
Finding check_silence(const std::vector<std::string>& hosts, const std::string& words, const std::string& self);

// About machines that answered, and then did not say which others they reach; with the last words, too.
Finding check_half_answer(const std::vector<std::string>& hosts, const std::string& words);

}  // namespace mars::doctor
