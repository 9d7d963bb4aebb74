#include "tests/fuzz/target.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <typeinfo>

#include "hal/failure/failure.h"

namespace mars::fuzz {
namespace {

constexpr std::size_t kLongestMessage = 30000;  // bytes; several lines of long lists

Counts counted;

[[noreturn]] void report(const char* what, const char* more) {
  std::fprintf(stderr, "FINDING: %s: %.1000s\n", what, more);
  std::abort();
}

// Nothing that a terminal would obey, and no book.
bool can_be_shown(std::string_view message) {
  const bool obeyed =
      std::ranges::any_of(message, [](unsigned char c) { return (c < ' ' && c != '\n' && c != '\t') || c == 127; });
  return !message.empty() && !obeyed && message.size() <= kLongestMessage;
}

}  // namespace

std::string run(std::string_view input) try {
  take(input);
  ++counted.taken;
  return "";
} catch (const Failure& failure) {
  ++counted.refused;
  if (!can_be_shown(failure.what())) report("a message that cannot be shown", failure.what());
  return failure.what();
} catch (const std::exception& exception) {
  report(typeid(exception).name(), exception.what());
}

const Counts& counts() { return counted; }

}  // namespace mars::fuzz
