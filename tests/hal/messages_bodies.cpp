// Bodies of what NX says of single messages beyond the everyday: errno, ids, handlers, Paragon forms.
#include "tests/hal/nx_bodies.h"

#include <cerrno>
#include <functional>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "hal/call_failure.h"
#include "hal/nx/nx_messages.h"

namespace mars::hal {
namespace {

// The errno of the failure that `call` ends with, or 0.
int code_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const CallFailure& failure) {
    return failure.code;
  }
  return 0;
}

int errno_of(long result) {
  EXPECT_EQ(result, -1);
  return result == -1 ? errno : 0;
}

void failures_carry_their_errno() {
  long x = 0;
  EXPECT_EQ(code_of([&] { csend(1'000'000'000, &x, 8, 0, 0); }), EQTYPE);
  EXPECT_EQ(code_of([&] { csend(1, &x, 8, numnodes() + 1, 0); }), EQNODE);
  EXPECT_EQ(code_of([&] { csend(1, &x, 8, 0, 1); }), EQPID);
  EXPECT_EQ(code_of([&] { csend(1, &x, -1, 0, 0); }), EQLEN);
  EXPECT_EQ(code_of([&] { csend(1, nullptr, 1, 0, 0); }), EQPBUF);
  EXPECT_EQ(code_of([&] { irecv(1, nullptr, 1); }), EQPBUF);
  EXPECT_EQ(code_of([&] { msgwait(4711); }), EQMID);
}

void twins_return_instead() {
  long x = 0;
  EXPECT_EQ(errno_of(_csend(2'000'000'000, &x, 8, 0, 0)), EQTYPE);
  EXPECT_EQ(errno_of(_crecv(1'000'000'000, &x, 8)), EQTYPE);
  EXPECT_EQ(errno_of(_isend(1, &x, 8, -2, 0)), EQNODE);
  EXPECT_EQ(errno_of(_irecv(1, &x, -8)), EQLEN);
  EXPECT_EQ(errno_of(_msgwait(-5)), EQMID);
  EXPECT_EQ(errno_of(_msgdone(-5)), EQMID);
  EXPECT_EQ(errno_of(_cprobe(1'000'000'000)), EQTYPE);
  EXPECT_EQ(errno_of(_iprobe(1'000'000'000)), EQTYPE);

  x = 12;
  EXPECT_EQ(_csend(1, &x, sizeof x, mynode(), 0), 0);
  EXPECT_EQ(_cprobe(1), 0);
  EXPECT_EQ(_iprobe(1), 1);
  EXPECT_EQ(errno_of(_crecv(1, &x, 1)), EQMSGLONG);
  const long mid = _irecv(1, &x, sizeof x);
  EXPECT_GE(mid, 0);
  EXPECT_EQ(_msgwait(mid), 0);
  EXPECT_EQ(_infonode(), mynode());
  EXPECT_EQ(_infocount(), static_cast<long>(sizeof x));
}

void gray_codes_are_neighbours() {
  std::set<long> codes;
  for (long n = 0; n < 64; ++n) {
    EXPECT_EQ(ginv(gray(n)), n);
    codes.insert(gray(n));
    const long change = gray(n) ^ gray((n + 1) % 64);
    EXPECT_EQ(change & (change - 1), 0);
    EXPECT_NE(change, 0);
  }
  EXPECT_EQ(codes.size(), 64u);
}

void hwclock_counts_nanoseconds() {
  const auto seconds = [] {
    esize_t ticks = {};
    hwclock(&ticks);
    EXPECT_LE(ticks.slow, 0xffffffffL);
    return (static_cast<double>(ticks.shigh) * 4294967296.0 + static_cast<double>(ticks.slow)) * 1e-9;
  };
  const double before = dclock();
  const double now = seconds();
  EXPECT_GE(now, before - 1e-6);
  EXPECT_LE(now, dclock() + 1e-6);
}

}  // namespace

std::vector<NxBody> messages_bodies() {
#define BODY(function) \
  NxBody { #function, function }
  return {BODY(failures_carry_their_errno), BODY(twins_return_instead), BODY(gray_codes_are_neighbours),
          BODY(hwclock_counts_nanoseconds)};
#undef BODY
}

}  // namespace mars::hal
