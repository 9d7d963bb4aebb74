#include "hal/failure/explain.h"

#include <filesystem>
#include <new>
#include <stdexcept>
#include <system_error>

#include "hal/failure/process_limit.h"

namespace mars {
namespace {

// As a shell takes it, in kB; "": none.
std::string own_limit() {
  const ProcessMemory limit = process_limit();
  if (limit.addresses != 0) return "ulimit -v " + std::to_string(limit.addresses >> 10);
  if (limit.data != 0) return "ulimit -d " + std::to_string(limit.data >> 10);
  return "";
}

}  // namespace

Failure within_limits(const std::string& problem, const std::string& where, const std::string& remedy) {
  const std::string limit = own_limit();
  if (limit.empty()) return Failure(problem, where, remedy);
  return Failure(problem + " within the limit of " + limit, where, "raise the limit, " + remedy);
}

Failure no_more_threads(const std::string& problem) { return within_limits(problem, "", "use fewer nodes"); }

Failure explain(const std::exception& reason) {
  if (const auto* failure = dynamic_cast<const Failure*>(&reason)) return *failure;
  if (dynamic_cast<const std::bad_alloc*>(&reason) || dynamic_cast<const std::length_error*>(&reason))
    return within_limits("there is no more memory to be had", "", "use fewer nodes, or set MARS_MEMORY to fewer MiB");
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

}  // namespace mars
