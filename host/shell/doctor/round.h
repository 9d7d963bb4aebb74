// The doctor's round: asks all machines at the same time, over commands that start MARS there and stay connected to it,
// and has the machines knock at each other's doors (answers.h). Each machine has a deadline.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "host/child/command.h"
#include "host/shell/doctor/answers.h"

namespace mars::doctor {

// A command asks one machine, or several that read the same words.
struct Call {
  std::vector<std::string> hosts;
  child::Command command;
};

struct RoundLimits {
  std::chrono::milliseconds answer{20000};   // until all have said what they are
  std::chrono::milliseconds meeting{20000};  // from then on until all have knocked
};

struct Round {
  Answers answers;
  std::vector<Finding> silences;  // machines that did not answer
};

// `self`: MARS's program on the machines. Throws Failure where a command cannot be started.
Round go_round(const std::vector<Call>& calls, const std::string& self, const RoundLimits& limits = {});

}  // namespace mars::doctor
