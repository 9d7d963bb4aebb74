// Expectations of the bodies of rules. Where one does not hold, the rank throws std::runtime_error with the place: that
// ends a world of any backend, so that no rank waits for one that gave up.
#pragma once

#include <concepts>
#include <functional>
#include <source_location>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mars::conformance {

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

// `call` throws a CallFailure of `code`, one of nx_errno.h, that names the rank and all of `parts`.
void expect_fails(int code, const std::function<void()>& call, const std::vector<std::string>& parts,
                  const Place& at = Place::current());

// `twin` returns -1 and sets errno to `code`.
void expect_errno(int code, const std::function<long()>& twin, const Place& at = Place::current());

// Both of an NX call: REFUSED(EQNODE, csend, (1, &x, 8, -2, 0), "no node -2"). They are called in this order, and the
// plain one names itself.
#define REFUSED(code, call, arguments, ...)                          \
  expect_fails(code, [&] { call arguments; }, {#call, __VA_ARGS__}); \
  expect_errno(code, [&] { return _##call arguments; })

}  // namespace mars::conformance
