// Findings as people read them: one line each, what to do below it; of several machines what is the same is
// printed once. And as lines for the doctor that asked this machine's.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/shell/doctor/checks.h"
#include "topology/machine.h"

namespace mars::doctor {

struct MachineFindings {
  std::string host;
  std::vector<Finding> findings;

  bool operator==(const MachineFindings&) const = default;
};

// "n1-n4,n7,login"; each once, in order.
std::string host_list(std::vector<std::string> hosts);

// Findings about the same thing on all machines, printed once where they are equal; else each names its hosts:
// "n3: ...". In the order of the first machine that has them.
std::vector<Finding> grouped(std::span<const MachineFindings> machines);

std::string text_of(std::span<const Finding> findings);

// The last line: what it comes to.
std::string verdict(std::span<const Finding> findings);

bool in_trouble(std::span<const Finding> findings);

// Only the troubles, a line each without the last one's end: for where something has just failed.
std::string short_text(std::span<const Finding> findings);

// From machine to machine: one line a finding.
std::string lines_of(const MachineFindings& machine);
// Adds a line to the machine that it is of; false if it is none of lines_of.
bool add_line(std::string_view line, std::vector<MachineFindings>& machines);

// Which node gets which cores of a machine, and how close that makes them.
std::string placement_text(const topology::Machine& machine, int nodes, int reserved);

}  // namespace mars::doctor
