#include "hal/failure/process_limit.h"

#include <sys/resource.h>

namespace mars {
namespace {

std::uint64_t limit_of(__rlimit_resource resource) {
  rlimit limit{};
  if (getrlimit(resource, &limit) != 0) return 0;
  return limit.rlim_cur == RLIM_INFINITY ? 0 : limit.rlim_cur;
}

}  // namespace

ProcessMemory process_limit() { return {limit_of(RLIMIT_AS), limit_of(RLIMIT_DATA)}; }

}  // namespace mars
