#include "hal/failure/failure.h"

#include <utility>

namespace mars {
namespace {

std::string one_line(const std::string& problem, const std::string& where, const std::string& remedy) {
  std::string line = where.empty() ? problem : where + ": " + problem;
  return remedy.empty() ? line : line + " (" + remedy + ")";
}

}  // namespace

Failure::Failure(std::string what, std::string where, std::string remedy)
    : std::runtime_error(one_line(what, where, remedy)),
      problem(std::move(what)),
      where(std::move(where)),
      remedy(std::move(remedy)) {}

void check(bool holds, const char* rule, std::source_location at) {
  if (holds) return;
  throw BrokenRule(std::string("a rule of MARS itself is broken: ") + rule + " (" + at.file_name() + ":" +
                   std::to_string(at.line()) + ", please report it)");
}

}  // namespace mars
