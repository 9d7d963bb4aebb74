// What bodies of rules expect. Where it does not hold, the rank throws std::runtime_error with the place: that ends a
// world of any backend, so that no rank waits for one that gave up.
#pragma once

#include <concepts>
#include <functional>
#include <source_location>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mars::hal::conformance {

using Place = std::source_location;

[[noreturn]] void broken(const std::string& how, const Place& at);

inline void expect(bool holds, std::string_view what, const Place& at = Place::current()) {
  if (!holds) broken(std::string(what) + " does not hold", at);
}

template <class Got, class Wanted>
void expect_equal(const Got& got, const Wanted& wanted, const Place& at = Place::current()) {
  bool equal = false;
  if constexpr (std::integral<Got> && std::integral<Wanted> && !std::same_as<Got, Wanted>)
    equal = std::cmp_equal(got, wanted);
  else
    equal = got == wanted;
  if (equal) return;
  std::ostringstream how;
  how << "it is " << got << ", not " << wanted;
  broken(how.str(), at);
}

void expect_in(const std::string& text, const std::vector<std::string>& parts, const Place& at = Place::current());

// `call` fails, telling all of `parts`.
void expect_fails(const std::function<void()>& call, const std::vector<std::string>& parts,
                  const Place& at = Place::current());

}  // namespace mars::hal::conformance
