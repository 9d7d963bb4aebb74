#include "topology/processor_limit.h"

#include <sched.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <limits>
#include <thread>

#include "topology/control_groups.h"

namespace mars::topology {
namespace {

namespace fs = std::filesystem;

// Microseconds of processors' time in each period; 0 or less: as much as there is.
struct Quota {
  std::int64_t time = 0;
  std::int64_t period = 0;
};

// "max" is no number.
Quota quota_of(const fs::path& group) {
  Quota quota;
  if (std::ifstream(group / "cpu.max") >> quota.time >> quota.period) return quota;
  quota = {};
  std::ifstream(group / "cpu.cfs_quota_us") >> quota.time;
  std::ifstream(group / "cpu.cfs_period_us") >> quota.period;
  return quota;
}

int processors_bound_to() {
  cpu_set_t mine;
  CPU_ZERO(&mine);
  if (sched_getaffinity(0, sizeof mine, &mine) == 0) return CPU_COUNT(&mine);
  return static_cast<int>(std::thread::hardware_concurrency());  // there are more processors than in a set
}

}  // namespace

int processor_limit(const fs::path& root) {
  constexpr std::int64_t kNone = std::numeric_limits<int>::max();
  std::int64_t least = kNone;
  for (const fs::path& group : control_groups("cpu", root)) {
    const Quota quota = quota_of(group);
    if (quota.time > 0 && quota.period > 0) least = std::min(least, (quota.time - 1) / quota.period + 1);
  }
  return least == kNone ? 0 : static_cast<int>(least);
}

int usable_processors() {
  const int bound = std::max(1, processors_bound_to()), limit = processor_limit();
  return limit == 0 ? bound : std::min(bound, limit);
}

}  // namespace mars::topology
