// A job of the 1992 program: the host and its nodes over some transport.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "node/wire/film.h"
#include "tests/bench/tables/machine1992/host.h"
#include "tests/bench/tables/machine1992/record.h"

namespace mars::machine1992 {

struct Task {
  wire::PackedFilm film;
  std::uint32_t interval = 0;
  std::uint32_t inbetweens = 0;  // the first of the interval, after its keyframe
};

struct Records {
  std::vector<std::vector<NodeRecord>> nodes;  // by node, the frames that it drew
  std::vector<WorkCounts> host;                // by frame
  bool operator==(const Records&) const = default;
};

// Runs both bodies as run_threads does.
using Run = std::function<void(int nodes, const std::function<void()>& host, const std::function<void()>& node)>;

Records run_job(const Task& task, int nodes, const Run& run, const Host::Show& show);

}  // namespace mars::machine1992
