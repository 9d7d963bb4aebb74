// How anything that is the user's or the world's fault is reported: what went wrong, where, and what to do
// about it. Caught once, at the top of each program and each thread, which reports it by explain.h. Our own bugs are
// `check`s, which stay on in a release. Depends on nothing: everything may use it.
#pragma once

#include <source_location>
#include <stdexcept>
#include <string>

namespace mars {

class Failure : public std::runtime_error {
 public:
  // `where` names a file, element and line, or a node and frame; `remedy` says what to do. Either may be "".
  Failure(std::string what, std::string where, std::string remedy);

  std::string problem;
  std::string where;
  std::string remedy;
};

// A `check` that failed.
class BrokenRule : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

// Throws BrokenRule naming the caller's file and line unless `holds`.
void check(bool holds, const char* rule, std::source_location at = std::source_location::current());

}  // namespace mars
