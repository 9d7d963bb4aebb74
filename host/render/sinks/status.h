// How a run goes, for people beside it: NAME.status in .runs (runs_folder.h), which the run replaces while it has its
// claim (status_file.h), and mars status reads.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/render/sinks/process_name.h"
#include "host/render/sinks/runs_folder.h"
#include "host/render/sinks/usage.h"

namespace mars::sinks {

struct Status {
  struct Node {
    std::int32_t node = 0;
    std::uint32_t frames = 0;  // it has drawn or helped to draw
    double silent = 0;         // seconds since the host has heard from it; 0: it was heard lately
    std::int32_t frame = -1;   // of a silent node: what it said last; -1: none
    std::string doing;
    double slow = 1;  // times as long as usual that it takes

    bool operator==(const Node&) const = default;
  };
  struct Machine {
    std::string name;
    std::vector<Node> nodes;

    bool operator==(const Machine&) const = default;
  };

  ProcessName process;       // the host's
  std::int64_t since = 0;    // seconds since 1970, by the host's clock
  std::int64_t written = 0;  // frames
  std::string film;
  std::string doing;       // as in events::Beat; "" before it is known
  std::uint32_t done = 0;  // frames of this run
  std::uint32_t of = 0;    // it renders; 0: not known yet
  double seconds = 0;      // of rendering
  std::optional<double> left;
  std::vector<Machine> machines;
  std::vector<std::string> warnings;  // the last ones
  Usage used;                         // so far

  bool operator==(const Status&) const = default;
};

std::string text_of(const Status& status);

// None where the run has none (any more), or what it has is none. Throws Failure where its file cannot be read.
std::optional<Status> status_of(const RunFiles& run);

}  // namespace mars::sinks
