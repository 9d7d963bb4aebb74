#include "hal/failure.h"

#include <new>

namespace mars {
namespace {

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

std::string reason_of(const std::exception& failure) {
  if (dynamic_cast<const std::bad_alloc*>(&failure) == nullptr) return failure.what();
  return "there is no more memory to be had (use fewer nodes, set MARS_MEMORY to fewer MiB, or raise the limit: "
         "mars doctor shows it)";
}

void check(bool holds, const char* rule, std::source_location at) {
  if (holds) return;
  throw std::logic_error(std::string("a rule of MARS itself is broken: ") + rule + " (" + at.file_name() +
                         ":" + std::to_string(at.line()) + ", please report it)");
}

}  // namespace mars
