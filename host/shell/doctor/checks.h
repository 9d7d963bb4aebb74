// From facts to findings: what is good, what is worth knowing, what is in the way, and what to do about it.
#pragma once

#include <string>
#include <vector>

#include "host/shell/doctor/facts.h"
#include "host/shell/launch/launch.h"

namespace mars::doctor {

struct Finding {
  enum class State { good, note, trouble };

  State state = State::good;
  std::string about;   // a word or two: "memory"
  std::string found;   // one line
  std::string remedy;  // "" where there is nothing to do

  bool operator==(const Finding&) const = default;
};

// Everything about one machine, always in the same order.
std::vector<Finding> check_machine(const Facts& facts);

// How a start went.
Finding check_start(const launch::Trial& trial);

// "8 GiB", "63 MiB"
std::string bytes_text(std::uint64_t bytes);

}  // namespace mars::doctor
