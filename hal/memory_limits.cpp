#include "hal/memory_limits.h"

#include <sys/resource.h>

#include <utility>

namespace mars {
namespace {

// As a shell takes it, in kB; "": none.
std::string own_limit() {
  for (const auto& [resource, option] : {std::pair(RLIMIT_AS, "ulimit -v "), std::pair(RLIMIT_DATA, "ulimit -d ")}) {
    rlimit limit{};
    if (getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
      return option + std::to_string(limit.rlim_cur >> 10);
  }
  return "";
}

}  // namespace

Failure within_limits(const std::string& problem, const std::string& where, const std::string& remedy) {
  const std::string limit = own_limit();
  if (limit.empty()) return Failure(problem, where, remedy);
  return Failure(problem + " within the limit of " + limit, where, "raise the limit, " + remedy);
}

Failure no_more_memory() {
  return within_limits("there is no more memory to be had", "", "use fewer nodes, or set MARS_MEMORY to fewer MiB");
}

Failure no_more_threads(const std::string& problem) { return within_limits(problem, "", "use fewer nodes"); }

}  // namespace mars
