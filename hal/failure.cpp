#include "hal/failure.h"

#include <filesystem>
#include <new>
#include <system_error>

#include "hal/memory_limits.h"

namespace mars {
namespace {

class BrokenRule : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

std::string one_line(const std::string& problem, const std::string& where, const std::string& remedy) {
  std::string line = where.empty() ? problem : where + ": " + problem;
  return remedy.empty() ? line : line + " (" + remedy + ")";
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
    return no_more_memory();
  if (const auto* file = dynamic_cast<const std::filesystem::filesystem_error*>(&reason))
    return Failure(file->code().message(), file->path1().string(), "");
  if (const auto* system = dynamic_cast<const std::system_error*>(&reason);
      system && system->code() == std::errc::resource_unavailable_try_again)
    return no_more_threads("the machine gives no more threads");
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
