// hsend, hrecv, hsendrecv and masktrap.
#include <algorithm>
#include <array>
#include <vector>

#include "hal/nx/nx_global.h"
#include "hal/nx/nx_messages.h"
#include "tests/hal/conformance/expect.h"
#include "tests/hal/conformance/rules.h"
#include "tests/hal/conformance/talk.h"

namespace mars::conformance {
namespace {

struct Call {
  long type, len, node, pid;

  bool operator==(const Call&) const = default;
};

// What the handlers of one rank have seen. Ranks may be threads: each has its own.
struct Seen {
  std::vector<Call> calls;
  long value = 0;  // a buffer
  long left = 0;   // how often a handler posts itself again
  long depth = 0;  // of handlers within handlers
  long deepest = 0;
};

Seen& seen() {
  static std::array<Seen, 128> of_rank;
  return of_rank.at(static_cast<std::size_t>(mynode()));
}

void note(long type, long len, long node, long pid) { seen().calls.push_back({type, len, node, pid}); }

Seen& forget() { return seen() = {}; }

// Until as many handlers have run.
void await_calls(std::size_t calls, const Place& at = Place::current()) {
  const double end = dclock() + 20;
  while (seen().calls.size() < calls) {
    if (dclock() > end) broken("the handler does not run", at);
    flick();
  }
  expect_equal(seen().calls.size(), calls, at);
}

RULE(hrecv_calls_once,
     "hrecv calls its handler once, with type, length, sender and pid, when the buffer holds the message",
     "not before the message has come; a second message waits for a receive of its own") {
  if (is_host()) {
    for (long node = 0; node < numnodes(); ++node) receive_empty(4);
    send_long(50, 1, -1);
    send_long(50, 2, -1);
    send_empty(51, -1);
    return;
  }
  Seen& here = forget();
  hrecv(50, &here.value, sizeof(long), note);
  for (int turn = 0; turn < 3; ++turn) flick();
  expect_equal(here.calls.size(), 0);
  send_empty(4, myhost());
  receive_empty(51);
  await_calls(1);
  expect(here.calls[0] == Call{50, sizeof(long), myhost(), 0}, "the handler gets the message's numbers");
  expect_equal(here.value, 1);
  expect_equal(iprobe(50), 1);
  expect_equal(receive_long(50), 2);
  expect_equal(here.calls.size(), 1);
}

RULE(hrecv_of_what_waits, "hrecv of a message that waits already calls its handler in this NX call or one of the next",
     "a waiting message of another type does not call it") {
  if (is_host()) return;
  Seen& here = forget();
  send_long(52, 1, mynode());
  send_long(53, 2, mynode());
  cprobe(53);
  hrecv(53, &here.value, sizeof(long), note);
  await_calls(1);
  expect_equal(here.value, 2);
  expect_equal(receive_long(52), 1);
  expect_equal(here.calls.size(), 1);
}

RULE(hrecv_is_a_posted_receive, "a message goes to an hrecv or an irecv, whichever was posted first",
     "neither kind comes before the other") {
  if (is_host()) return;
  Seen& here = forget();
  long first = 0, third = 0;
  const long before = irecv(54, &first, sizeof first);
  hrecv(-1, &here.value, sizeof(long), note);
  const long after = irecv(54, &third, sizeof third);
  for (const long value : {1, 2, 3}) send_long(54, value, mynode());
  msgwait(after);
  msgwait(before);
  await_calls(1);
  expect_equal(first, 1);
  expect_equal(here.value, 2);
  expect_equal(third, 3);
}

void count_and_post_again(long, long, long node, long) {
  Seen& here = seen();
  here.calls.push_back({here.value, 0, node, 0});
  if (--here.left > 0) hrecv(55, &here.value, sizeof(long), count_and_post_again);
}

RULE(handlers_post_again, "a handler may post itself again, as in a counter that all nodes use",
     "no message is lost while no handler is posted, and the messages of each node stay in order") {
  constexpr long kTimes = 20;
  if (!is_host()) {
    for (long i = 0; i < kTimes; ++i) send_long(55, i, myhost());
    return;
  }
  Seen& here = forget();
  here.left = kTimes * numnodes();
  hrecv(55, &here.value, sizeof(long), count_and_post_again);
  await_calls(static_cast<std::size_t>(kTimes * numnodes()));
  std::vector<long> next(static_cast<std::size_t>(numnodes()));
  for (const Call& call : here.calls) expect_equal(call.type, next[static_cast<std::size_t>(call.node)]++);
}

RULE(hsend_calls_once, "hsend calls its handler once, with type, length, receiver and pid, when the buffer is free",
     "the receiver does not see what is written to the buffer after that") {
  if (is_host()) return;
  forget();
  Bytes mine = pattern(300'000, 1);
  hsend(56, mine.data(), length_of(mine), next_node(), 0, note);
  Bytes theirs(mine.size());
  crecv(56, theirs.data(), length_of(theirs));
  await_calls(1);
  mine.assign(mine.size(), 0);
  expect(theirs == pattern(300'000, 1), "the message is whole");
  expect(seen().calls[0] == Call{56, 300'000, next_node(), 0}, "the handler gets the message's numbers");
  for (int turn = 0; turn < 3; ++turn) flick();
  expect_equal(seen().calls.size(), 1);
}

RULE(hsendrecv_calls_for_the_answer, "hsendrecv sends, and calls its handler when the answer is in the buffer",
     "not when the message has been sent") {
  if (is_host()) {
    std::vector<long> questions;
    for (long node = 0; node < numnodes(); ++node) questions.push_back(receive_long(100 + node));
    for (long node = 0; node < numnodes(); ++node) receive_empty(59);
    for (long node = 0; node < numnodes(); ++node) send_long(58, 2 * questions[static_cast<std::size_t>(node)], node);
    return;
  }
  Seen& here = forget();
  const long question = 1000 + mynode();
  hsendrecv(100 + mynode(), &question, sizeof question, myhost(), 0, 58, &here.value, sizeof(long), note);
  for (int turn = 0; turn < 3; ++turn) flick();
  expect_equal(here.calls.size(), 0);
  send_empty(59, myhost());
  await_calls(1);
  expect(here.calls[0] == Call{58, sizeof(long), myhost(), 0}, "the handler gets the answer's numbers");
  expect_equal(here.value, 2 * question);
}

RULE(masktrap_holds_back, "masktrap(1) holds handlers back until masktrap(0), and returns the previous state",
     "a message that comes meanwhile calls its handler after masktrap(0), not before") {
  if (is_host()) return;
  Seen& here = forget();
  expect_equal(masktrap(1), 0);
  expect_equal(masktrap(1), 1);
  hrecv(60, &here.value, sizeof(long), note);
  send_long(60, 7, mynode());
  send_empty(61, mynode());
  receive_empty(61);  // the one before has come too
  for (int turn = 0; turn < 3; ++turn) flick();
  expect_equal(here.calls.size(), 0);
  expect_equal(iprobe(60), 0);
  expect_equal(here.value, 7);  // it has come, but its handler has not run
  expect_equal(masktrap(0), 1);
  expect_equal(here.calls.size(), 1);
  expect_equal(masktrap(0), 0);
}

RULE(too_long_for_an_hrecv, "a message too long for an hrecv fails the call in which the handler would have run",
     "the handler does not run, and the message goes on waiting") {
  if (is_host()) return;
  Seen& here = forget();
  masktrap(1);
  hrecv(60, &here.value, 4, note);
  send_long(60, 7, mynode());
  cprobe(60);
  expect_fails(EQMSGLONG, [] { masktrap(0); }, {"hrecv", "8 bytes", "4 bytes"});
  expect_equal(here.value, 0);
  expect_equal(receive_long(60), 7);
  expect_equal(here.calls.size(), 0);
}

RULE(a_handler_fails_a_crecv, "a crecv that fails because an hrecv's message is too long takes nothing",
     "the message for which the crecv waited goes to the next crecv") {
  if (is_host()) {
    for (long node = 0; node < numnodes(); ++node) receive_empty(4);
    let_pass(0.002);  // the crecvs wait by now
    send_long(60, 7, -1);
    return;
  }
  Seen& here = forget();
  hrecv(60, &here.value, 4, note);
  send_empty(4, myhost());
  long value = 0;
  expect_errno(EQMSGLONG, [&] { return _crecv(61, &value, sizeof value); });
  expect_equal(receive_long(60), 7);
  send_long(61, 5, mynode());
  expect_equal(receive_long(61), 5);
  expect_equal(value, 0);
}

void note_info(long, long, long, long) { note(infotype(), infocount(), infonode(), infopid()); }

RULE(info_in_handlers, "in a handler info* describe its own message", "the interrupted program's info* do not change") {
  if (is_host()) return;
  Seen& here = forget();
  csend(72, "abc", 3, next_node(), 0);
  char text[3];
  crecv(72, text, 3);
  hrecv(73, &here.value, sizeof(long), note_info);
  send_long(73, 1, mynode());
  await_calls(1);
  expect(here.calls[0] == Call{73, sizeof(long), mynode(), 0}, "the handler sees its own message");
  expect_equal(infotype(), 72);
  expect_equal(infocount(), 3);
  expect_equal(infonode(), previous_node());
}

RULE(handlers_run_in_order, "handlers run in the order in which their messages came", "not in the order of posting") {
  if (is_host()) return;
  forget();
  masktrap(1);
  for (const long type : {62, 63, 64}) hrecv(type, nullptr, 0, note);
  for (const long type : {64, 62, 63}) send_empty(type, mynode());
  send_empty(65, mynode());
  receive_empty(65);
  masktrap(0);
  await_calls(3);
  expect_equal(seen().calls[0].type, 64);
  expect_equal(seen().calls[1].type, 62);
  expect_equal(seen().calls[2].type, 63);
}

void answer(long type, long len, long node, long pid) {
  Seen& here = seen();
  here.deepest = std::max(here.deepest, ++here.depth);
  const long value = here.value;
  if (--here.left > 0) hrecv(66, &here.value, sizeof(long), answer);
  send_long(67, 2 * value, node);
  send_long(68, value, mynode());
  expect_equal(receive_long(68), value);
  note(type, len, node, pid);
  --here.depth;
}

RULE(nx_calls_in_handlers, "a handler may send, receive and post; handlers run one at a time",
     "no handler runs within another, even if messages for it come") {
  constexpr long kTimes = 10;
  if (!is_host()) {
    for (long i = 0; i < kTimes; ++i) send_long(66, i, myhost());
    for (long i = 0; i < kTimes; ++i) expect_equal(receive_long(67), 2 * i);
    return;
  }
  Seen& here = forget();
  here.left = kTimes * numnodes();
  hrecv(66, &here.value, sizeof(long), answer);
  await_calls(static_cast<std::size_t>(kTimes * numnodes()));
  expect_equal(here.deepest, 1);
}

void pass_on(long, long, long, long) { send_long(70, seen().value, mynode()); }

RULE(handlers_run_in_waits, "a handler runs while its process waits in crecv",
     "the crecv goes on waiting for its own message") {
  if (is_host()) return;
  hrecv(69, &forget().value, sizeof(long), pass_on);
  send_long(69, 5, next_node());
  expect_equal(receive_long(70), 5);
  expect_equal(infotype(), 70);
}

RULE(handlers_run_in_probes, "a handler runs while its process waits in cprobe",
     "the cprobe finds what the handler sends to its own process") {
  if (is_host()) return;
  hrecv(71, &forget().value, sizeof(long), pass_on);
  send_long(71, 6, next_node());
  cprobe(70);
  expect_equal(infotype(), 70);
  expect_equal(receive_long(70), 6);
}

RULE(handlers_run_in_global_operations, "a handler runs while its process waits in a global operation",
     "no deadlock if the other nodes call it only after the handler has answered them") {
  if (is_host()) return;
  Seen& here = forget();
  const std::size_t questions = 3 * static_cast<std::size_t>(numnodes() - 1);
  here.left = static_cast<long>(questions);
  if (mynode() == 0 && questions > 0) hrecv(66, &here.value, sizeof(long), answer);
  const auto ask = [](long question) {
    if (mynode() == 0) return;
    send_long(66, question, 0);
    expect_equal(receive_long(67), 2 * question);
  };
  long x = 1, work = 0, count = 0;
  ask(1);
  gisum(&x, 1, &work);
  expect_equal(x, numnodes());
  ask(2);
  gsync();
  ask(3);
  std::vector<long> all(static_cast<std::size_t>(numnodes()));
  gcol(&x, sizeof x, all.data(), numnodes() * static_cast<long>(sizeof x), &count);
  if (mynode() == 0) expect_equal(here.calls.size(), questions);
}

RULE(wrong_arguments_of_handlers, "hsend, hrecv and hsendrecv check as isend and irecv do",
     "EQTYPE, EQNODE, EQPID, EQLEN, EQPBUF") {
  long x = 0;
  REFUSED(EQTYPE, hrecv, (1'000'000'000, &x, 8, note), "reserved");
  REFUSED(EQLEN, hrecv, (1, &x, -8, note), "length -8");
  REFUSED(EQPBUF, hrecv, (1, nullptr, 8, note), "null");
  REFUSED(EQTYPE, hsend, (-1, &x, 8, 0, 0, note), "type -1");
  REFUSED(EQNODE, hsend, (1, &x, 8, numnodes() + 1, 0, note), "no node");
  REFUSED(EQPID, hsend, (1, &x, 8, 0, 1, note), "pid 1");
  REFUSED(EQLEN, hsend, (1, &x, -1, 0, 0, note), "length -1");
  REFUSED(EQPBUF, hsend, (1, nullptr, 1, 0, 0, note), "null");
  REFUSED(EQPBUF, hrecv, (1, &x, 8, nullptr), "handler");
  REFUSED(EQPBUF, hsend, (1, &x, 8, 0, 0, nullptr), "handler");
  REFUSED(EQPBUF, hsendrecv, (1, &x, 8, 0, 0, 1, &x, 8, nullptr), "handler");
  REFUSED(EQTYPE, hsendrecv, (1'000'000'000, &x, 8, 0, 0, 1, &x, 8, note), "1000000000");
  REFUSED(EQTYPE, hsendrecv, (1, &x, 8, mynode(), 0, 1'000'000'001, &x, 8, note), "1000000001");
  REFUSED(EQLEN, hsendrecv, (1, &x, 8, mynode(), 0, 1, &x, -8, note), "length -8");
  expect_equal(iprobe(1), 0);  // no question was sent
}

}  // namespace
}  // namespace mars::conformance
