#include "tests/fuzz/target.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <typeinfo>
#include <utility>

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

// Filled before main, in any order.
std::vector<const Target*>& registered_targets() {
  static std::vector<const Target*> targets;
  return targets;
}

}  // namespace

Target::Target(std::string name, Form form, void (*take)(std::string_view input))
    : name(std::move(name)), form(form), take(take) {
  registered_targets().push_back(this);
}

std::vector<const Target*> all_targets() {
  std::vector<const Target*> targets = registered_targets();
  std::ranges::sort(targets, {}, &Target::name);
  return targets;
}

std::string run(const Target& target, std::string_view input) try {
  target.take(input);
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
