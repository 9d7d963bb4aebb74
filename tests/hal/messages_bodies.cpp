// Bodies of what NX says of single messages beyond the everyday: errno, ids, cancelling, Paragon forms.
#include "tests/hal/nx_bodies.h"

#include <cerrno>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hal/call_failure.h"
#include "hal/nx/nx_global.h"
#include "hal/nx/nx_paragon.h"

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

bool is_host() { return mynode() == myhost(); }

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

void send_long(long type, long value, long to) { csend(type, &value, sizeof value, to, 0); }

long receive_long(long typesel) {
  long value = -1;
  crecv(typesel, &value, sizeof value);
  return value;
}

long next_node() { return (mynode() + 1) % numnodes(); }
long previous_node() { return (mynode() + numnodes() - 1) % numnodes(); }

void an_exchange_returns_the_answers_length() {
  if (is_host()) return;
  char in[100] = "";
  EXPECT_EQ(csendrecv(10, "question", 9, next_node(), 0, 10, in, sizeof in), 9);
  EXPECT_STREQ(in, "question");
  EXPECT_EQ(infonode(), previous_node());
  const long mid = isendrecv(11, "again", 6, next_node(), 0, 11, in, sizeof in);
  msgwait(mid);
  EXPECT_STREQ(in, "again");
  EXPECT_EQ(infotype(), 11);
  EXPECT_EQ(infocount(), 6);
  EXPECT_EQ(errno_of(_msgwait(mid)), EQMID);
  EXPECT_EQ(errno_of(_csendrecv(1, in, 1, 0, 5, 1, in, 1)), EQPID);
  EXPECT_EQ(errno_of(_isendrecv(1, in, 1, 0, 0, 1, nullptr, 1)), EQPBUF);
}

void a_receive_of_what_waits_fails_at_its_end_too() {
  if (is_host()) return;
  send_long(12, 1, mynode());
  cprobe(12);
  char in = 0;
  for (int look = 0; look < 2; ++look) {
    const long mid = irecv(12, &in, 1);
    EXPECT_EQ(errno_of(_msgwait(mid)), EQMSGLONG);
    EXPECT_EQ(errno_of(_csendrecv(13, &in, 1, mynode(), 0, 12, &in, 1)), EQMSGLONG);
    EXPECT_EQ(errno_of(_msgwait(isendrecv(13, &in, 1, mynode(), 0, 12, &in, 1))), EQMSGLONG);
  }
  EXPECT_EQ(receive_long(12), 1);
  for (int i = 0; i < 4; ++i) crecv(13, &in, 1);
}

void a_cancelled_receive_takes_nothing() {
  if (is_host()) return;
  long value = 0, other = 0;
  const long mid = irecv(50, &value, sizeof value);
  msgcancel(mid);
  EXPECT_EQ(errno_of(_msgcancel(mid)), EQMID);
  send_long(50, 1, mynode());
  EXPECT_EQ(receive_long(50), 1);
  EXPECT_EQ(value, 0);

  // What it has already goes back to its place, or to the next receive that waits.
  const long first = irecv(51, &value, sizeof value);
  for (long i = 1; i <= 3; ++i) send_long(51, i, mynode());
  cprobe(51);
  EXPECT_EQ(value, 1);
  msgcancel(first);
  const long second = irecv(51, &value, sizeof value);
  for (long i = 2; i <= 3; ++i) EXPECT_EQ(receive_long(51), i);
  const long third = irecv(51, &other, sizeof other);
  EXPECT_EQ(value, 1);
  msgcancel(second);
  msgwait(third);
  EXPECT_EQ(other, 1);
}

void a_cancelled_send_has_gone() {
  if (is_host()) return;
  const std::vector<long> data(100'000, 5);
  const auto bytes = static_cast<long>(data.size() * sizeof(long));
  std::vector<long> in(data.size());
  msgcancel(isend(52, data.data(), bytes, next_node(), 0));
  crecv(52, in.data(), bytes);
  EXPECT_EQ(in, data);
}

void flushed_messages_are_gone() {
  if (is_host()) {
    send_long(53, 1, -1);
    send_long(54, 2, -1);
    send_long(55, 3, -1);
    return;
  }
  cprobe(55);
  send_long(53, 4, mynode());
  cprobe(53);
  flushmsg(53, myhost(), 0);
  EXPECT_EQ(receive_long(53), 4);
  flushmsg(53, -1, -1);
  EXPECT_EQ(iprobe(53), 0);
  flushmsg(-1, mynode(), 0);
  EXPECT_EQ(receive_long(55), 3);
  flushmsg(-1, -1, 0);
  EXPECT_EQ(iprobe(-1), 0);
  EXPECT_EQ(errno_of(_flushmsg(-1, -2, 0)), EQNODE);
  EXPECT_EQ(errno_of(_flushmsg(-1, 0, 1)), EQPID);
  EXPECT_EQ(errno_of(_flushmsg(1'000'000'000, 0, 0)), EQTYPE);
}

void ids_are_scarce() {
  if (!is_host()) return;
  std::vector<long> mids;
  long mid = 0;
  while ((mid = _irecv(56, nullptr, 0)) >= 0) mids.push_back(mid);
  EXPECT_EQ(errno, EQNOMID);
  EXPECT_EQ(mids.size(), 65536u);
  EXPECT_EQ(errno_of(_isend(57, nullptr, 0, mynode(), 0)), EQNOMID);
  EXPECT_EQ(errno_of(_isendrecv(57, nullptr, 0, mynode(), 0, 57, nullptr, 0)), EQNOMID);
  send_long(57, 1, mynode());  // needs none
  EXPECT_EQ(receive_long(57), 1);
  msgcancel(mids.back());
  mids.back() = irecv(56, nullptr, 0);
  for (std::size_t i = mids.size(); i-- > 0;) msgcancel(mids[i]);
}

void a_posted_receive_that_is_too_short_fails_at_its_end() {
  if (is_host()) return;
  char small[4] = "abc";
  long large = 0;
  const long first = irecv(58, small, 4);
  const long second = irecv(58, small, 1);
  const long third = irecv(58, &large, sizeof large);
  send_long(58, 9, mynode());
  EXPECT_EQ(code_of([&] { msgwait(third); }), 0);
  EXPECT_EQ(large, 9);
  EXPECT_EQ(errno_of(_msgdone(first)), EQMSGLONG);
  EXPECT_EQ(errno_of(_msgwait(second)), EQMSGLONG);
  EXPECT_STREQ(small, "abc");
  EXPECT_EQ(errno_of(_msgwait(second)), EQMID);

  // Where nobody has room it stays.
  const long fourth = irecv(58, small, 4);
  send_long(58, 10, mynode());
  EXPECT_EQ(errno_of(_msgwait(fourth)), EQMSGLONG);
  EXPECT_EQ(receive_long(58), 10);
}

constexpr long kForce = 1'073'741'824;

void probes_find_no_force_messages() {
  if (is_host()) return;
  EXPECT_EQ(errno_of(_cprobe(kForce)), EQTYPE);
  send_long(kForce, 1, mynode());
  send_long(59, 2, mynode());
  EXPECT_EQ(iprobe(kForce), 0);
  EXPECT_EQ(receive_long(-1), 2);
  long forced = 0;
  const long first = irecv(kForce, &forced, sizeof forced);
  const long second = irecv(kForce, &forced, sizeof forced);
  send_long(kForce, 3, mynode());
  send_long(59, 4, mynode());
  EXPECT_EQ(receive_long(-1), 4);
  msgcancel(first);  // its message goes to the other
  msgwait(second);
  EXPECT_EQ(forced, 3);
}

void paragon_receives_choose_the_sender() {
  if (is_host()) {
    send_long(60, 100, -1);
    return;
  }
  send_long(60, mynode(), next_node());
  long value = 0, info[8], later[8] = {};
  cprobex(60, previous_node(), 0, info);
  EXPECT_EQ(info[2], previous_node());
  crecvx(60, &value, sizeof value, myhost(), -1, info);
  EXPECT_EQ(value, 100);
  EXPECT_EQ(info[0], 60);
  EXPECT_EQ(info[1], static_cast<long>(sizeof(long)));
  EXPECT_EQ(info[2], myhost());
  EXPECT_EQ(info[3], 0);
  EXPECT_EQ(infonode(), myhost());
  EXPECT_EQ(iprobex(60, myhost(), 0, msginfo), 0);
  const long mid = irecvx(-1, &value, sizeof value, previous_node(), -1, later);
  msgwait(mid);
  EXPECT_EQ(value, previous_node());
  EXPECT_EQ(later[0], 60);
  EXPECT_EQ(later[2], previous_node());
  EXPECT_EQ(errno_of(_crecvx(60, &value, 8, numnodes() + 1, 0, info)), EQNODE);
  EXPECT_EQ(errno_of(_irecvx(60, &value, 8, -1, 3, info)), EQPID);
  EXPECT_EQ(errno_of(_iprobex(2'000'000'000, -1, 0, info)), EQTYPE);
}

void paragon_ids_merge_and_are_ignored() {
  if (is_host()) return;
  long first = 0, second = 0;
  const long one = irecv(61, &first, sizeof first);
  const long two = irecv(62, &second, sizeof second);
  const long both = msgmerge(one, msgmerge(-1, two));
  EXPECT_EQ(msgmerge(both, -1), both);
  EXPECT_EQ(errno_of(_msgmerge(both, both)), EQMID);
  send_long(62, 2, mynode());
  EXPECT_EQ(msgdone(both), 0);
  if (two != both) {
    EXPECT_EQ(errno_of(_msgdone(two)), EQMID);
  }
  send_long(61, 1, mynode());
  msgwait(both);
  EXPECT_EQ(first, 1);
  EXPECT_EQ(second, 2);
  EXPECT_EQ(infotype(), 61);

  const long ignored = irecv(63, &first, sizeof first);
  msgignore(ignored);
  EXPECT_EQ(errno_of(_msgwait(ignored)), EQMID);
  send_long(63, 3, mynode());
  send_long(64, 4, mynode());
  receive_long(64);
  EXPECT_EQ(first, 3);
  EXPECT_EQ(infotype(), 64);

  setptype(myptype());
  EXPECT_EQ(infoptype(), 0);
  EXPECT_EQ(errno_of(_setptype(5)), EQPID);
}

}  // namespace

std::vector<NxBody> messages_bodies() {
#define BODY(function) \
  NxBody { #function, function }
  return {BODY(failures_carry_their_errno),
          BODY(twins_return_instead),
          BODY(gray_codes_are_neighbours),
          BODY(hwclock_counts_nanoseconds),
          BODY(an_exchange_returns_the_answers_length),
          BODY(a_receive_of_what_waits_fails_at_its_end_too),
          BODY(a_cancelled_receive_takes_nothing),
          BODY(a_cancelled_send_has_gone),
          BODY(flushed_messages_are_gone),
          BODY(ids_are_scarce),
          BODY(a_posted_receive_that_is_too_short_fails_at_its_end),
          BODY(probes_find_no_force_messages),
          BODY(paragon_receives_choose_the_sender),
          BODY(paragon_ids_merge_and_are_ignored)};
#undef BODY
}

}  // namespace mars::hal
