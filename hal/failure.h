// How anything that is the user's or the world's fault is told: what went wrong, where, and what to do
// about it. Caught once, at the top of each program and each thread (docs/errors.md). Our own bugs are
// `check`s, which stay on in a release.
#pragma once

#include <exception>
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

// What to tell of any failure: what the libraries throw says of itself neither what nor what to do.
Failure explain(const std::exception& reason);
std::string reason_of(const std::exception& failure);

// Throws std::logic_error naming the caller's file and line unless `holds`.
void check(bool holds, const char* rule, std::source_location at = std::source_location::current());

}  // namespace mars
