#include "hal/failure.h"

#include <sys/resource.h>

#include <filesystem>
#include <new>
#include <optional>
#include <system_error>

namespace mars {
namespace {

class BrokenRule : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

// Of the process's memory, in kB, as ulimit takes it: its option and value.
std::optional<std::pair<const char*, std::uint64_t>> memory_limit() {
  for (const auto& [resource, option] : {std::pair(RLIMIT_AS, "ulimit -v"), std::pair(RLIMIT_DATA, "ulimit -d")}) {
    rlimit limit{};
    if (getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) return {{option, limit.rlim_cur >> 10}};
  }
  return std::nullopt;
}

std::string one_line(const std::string& problem, const std::string& where, const std::string& remedy) {
  std::string line = where.empty() ? problem : where + ": " + problem;
  return remedy.empty() ? line : line + " (" + remedy + ")";
}

Failure too_little_memory() {
  const auto limit = memory_limit();
  const std::string within =
      limit ? std::string(" within the limit of ") + limit->first + " " + std::to_string(limit->second) : "";
  return Failure("there is no more memory to be had" + within, "",
                 std::string(limit ? "raise the limit, " : "") + "use fewer nodes, or set MARS_MEMORY to fewer MiB");
}

}  // namespace

Failure::Failure(std::string what, std::string at, std::string mend)
    : std::runtime_error(one_line(what, at, mend)),
      problem(std::move(what)),
      where(std::move(at)),
      remedy(std::move(mend)) {}

Failure explain(const std::exception& reason) {
  if (const auto* failure = dynamic_cast<const Failure*>(&reason)) return *failure;
  if (dynamic_cast<const std::bad_alloc*>(&reason) || dynamic_cast<const std::length_error*>(&reason))
    return too_little_memory();
  if (const auto* file = dynamic_cast<const std::filesystem::filesystem_error*>(&reason))
    return Failure(file->code().message(), file->path1().string(), "");
  if (const auto* system = dynamic_cast<const std::system_error*>(&reason))
    return Failure(system->code().message(), "", "");
  if (dynamic_cast<const BrokenRule*>(&reason)) return Failure(reason.what(), "", "");
  return Failure(std::string("MARS did not expect this: ") + reason.what(), "", "please report it with the command");
}

std::string reason_of(const std::exception& failure) { return explain(failure).what(); }

void check(bool holds, const char* rule, std::source_location at) {
  if (holds) return;
  throw BrokenRule(std::string("a rule of MARS itself is broken: ") + rule + " (" + at.file_name() +
                   ":" + std::to_string(at.line()) + ", please report it)");
}

}  // namespace mars
