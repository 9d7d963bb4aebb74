#include "hal/failure/failure.h"

#include <utility>

#include "hal/failure/plain_text.h"

namespace mars {
namespace {

constexpr std::size_t kLongest = 8000;  // bytes

// What files, people and other machines wrote is part of failures' texts.
std::string cut(std::string text) {
  if (text.size() > kLongest) text.replace(kLongest, std::string::npos, "...");
  return text;
}

std::string shown(std::string text) { return plain_text(cut(std::move(text))); }

// A file's name may have a line's end in it, and what follows would look like a message of ours.
std::string place(std::string text) { return plain_line(cut(std::move(text))); }

std::string one_line(const std::string& problem, const std::string& where, const std::string& remedy) {
  std::string line = where.empty() ? problem : where + ": " + problem;
  return remedy.empty() ? line : line + " (" + remedy + ")";
}

}  // namespace

Failure::Failure(std::string what, std::string where, std::string remedy)
    : std::runtime_error(one_line(shown(what), place(where), shown(remedy))),
      problem(shown(std::move(what))),
      where(place(std::move(where))),
      remedy(shown(std::move(remedy))) {}

void check(bool holds, const char* rule, std::source_location at) {
  if (holds) return;
  throw BrokenRule(std::string("a rule of MARS itself is broken: ") + rule + " (" + at.file_name() + ":" +
                   std::to_string(at.line()) + ", please report it)");
}

}  // namespace mars
