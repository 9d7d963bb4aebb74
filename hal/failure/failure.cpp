#include "hal/failure/failure.h"

#include <utility>

#include "hal/failure/plain_text.h"

namespace mars {
namespace {

constexpr std::size_t kLongest = 8000;  // bytes

// What files, people and other machines wrote is part of failures' texts.
std::string shown(std::string text) {
  if (text.size() > kLongest) text.replace(kLongest, std::string::npos, "...");
  return plain_text(text);
}

std::string one_line(const std::string& problem, const std::string& where, const std::string& remedy) {
  std::string line = where.empty() ? problem : where + ": " + problem;
  return remedy.empty() ? line : line + " (" + remedy + ")";
}

}  // namespace

Failure::Failure(std::string what, std::string where, std::string remedy)
    : std::runtime_error(one_line(shown(what), shown(where), shown(remedy))),
      problem(shown(std::move(what))),
      where(shown(std::move(where))),
      remedy(shown(std::move(remedy))) {}

void check(bool holds, const char* rule, std::source_location at) {
  if (holds) return;
  throw BrokenRule(std::string("a rule of MARS itself is broken: ") + rule + " (" + at.file_name() + ":" +
                   std::to_string(at.line()) + ", please report it)");
}

}  // namespace mars
