// msgcancel and flushmsg, and message ids that run out.
#include <vector>

#include "hal/nx/nx_messages.h"
#include "tests/hal/conformance/expect.h"
#include "tests/hal/conformance/rules.h"
#include "tests/hal/conformance/talk.h"

namespace mars::hal::conformance {
namespace {

RULE(cancelled_receives, "msgcancel of a receive frees its id, and its message goes to the next receive that selects it",
     "nothing is written to the buffer; the id is EQMID") {
  if (is_host()) return;
  long never = -7, next = 0;
  const long cancelled = irecv(40, &never, sizeof never);
  const long kept = irecv(40, &next, sizeof next);
  msgcancel(cancelled);
  send_long(40, 1, mynode());
  msgwait(kept);
  expect_equal(next, 1);
  expect_equal(never, -7);
  REFUSED(EQMID, msgcancel, (cancelled), "no message id " + std::to_string(cancelled));
  REFUSED(EQMID, msgwait, (cancelled), "no message id");
}

RULE(cancelled_before_it_comes, "a message that comes after its receive was cancelled waits to be received",
     "it is not lost with the receive") {
  if (is_host()) return;
  long value = 0;
  msgcancel(irecv(41, &value, sizeof value));
  send_long(41, 2, mynode());
  expect_equal(receive_long(41), 2);
  expect_equal(value, 0);
}

RULE(cancelled_when_done, "msgcancel of a receive that has its message already gives the message back",
     "it waits in its old place, before those that came later") {
  if (is_host()) return;
  long value = 0;
  const long mid = irecv(42, &value, sizeof value);
  send_long(42, 3, mynode());
  send_long(42, 4, mynode());
  send_empty(43, mynode());
  receive_empty(43);  // those before it have come too
  msgcancel(mid);
  expect_equal(receive_long(-1), 3);
  expect_equal(receive_long(-1), 4);
  REFUSED(EQMID, msgdone, (mid), "no message id");
}

RULE(cancelled_at_once, "msgcancel of a receive that is not done does not look for its message first",
     "the next receive does not get the second message instead of the first, also where a handler waits") {
  if (is_host()) return;
  long first = 0, second = 0;
  hrecv(52, nullptr, 0, [](long, long, long, long) {});
  const long mid = irecv(42, &first, sizeof first);
  const long other = irecv(42, &second, sizeof second);
  send_long(42, 1, mynode());
  send_long(42, 2, mynode());
  msgcancel(mid);
  msgwait(other);
  expect_equal(second, 1);
  expect_equal(receive_long(42), 2);
  send_empty(52, mynode());
  while (iprobe(52) == 1) flick();
}

RULE(cancelled_for_another, "a message that a cancelled receive gives back goes to the next posted receive that selects it",
     "it does not wait beside it") {
  if (is_host()) return;
  long first = 0, second = 0;
  const long mid = irecv(42, &first, sizeof first);
  const long other = irecv(-1, &second, sizeof second);
  send_long(42, 3, mynode());
  msgcancel(mid);
  msgwait(other);
  expect_equal(second, 3);
}

RULE(cancelled_sends, "msgcancel of a send frees its id and its buffer", "a message that has gone is not called back") {
  if (is_host()) return;
  long value = 4;
  const long mid = isend(44, &value, sizeof value, next_node(), 0);
  msgcancel(mid);
  value = 5;
  expect_equal(receive_long(44), 4);
  REFUSED(EQMID, msgwait, (mid), "no message id");
}

RULE(cancel_takes_ids, "msgcancel takes message ids alone", "EQMID for what never was one") {
  REFUSED(EQMID, msgcancel, (-1), "no message id -1");
  REFUSED(EQMID, msgcancel, (0x7fffffff), "no message id 2147483647");
}

RULE(ids_run_out, "message ids are scarce: when all are in use the next call is EQNOMID",
     "all can be used again once freed, and nothing was posted or sent by the call that failed") {
  if (mynode() != 0) return;
  // Of empty messages to itself: they are sent at once, and their ids stay in use.
  const auto use_all = [] {
    std::vector<long> mids;
    for (long mid = 0; mids.size() < 1'000'000 && (mid = _isend(45, nullptr, 0, 0, 0)) >= 0;) mids.push_back(mid);
    return mids;
  };
  const auto free_all = [](const std::vector<long>& mids) {
    for (const long mid : mids) msgwait(mid);
    flushmsg(45, -1, -1);
  };
  const std::vector<long> mids = use_all();
  expect(mids.size() >= 100 && mids.size() < 1'000'000, "there are some ids, and not more");
  REFUSED(EQNOMID, irecv, (46, nullptr, 0), "message ids");
  REFUSED(EQNOMID, isend, (46, nullptr, 0, 0, 0), "message ids");
  expect_equal(iprobe(46), 0);
  send_long(47, 9, 0);  // that need no id of the program's
  expect_equal(receive_long(47), 9);
  free_all(mids);
  const std::vector<long> again = use_all();
  expect_equal(again.size(), mids.size());
  free_all(again);
  expect_equal(iprobe(45), 0);
}

// Each node sends itself a message of each type; what is left after the flush is received in order.
void flush_and_expect(const std::vector<long>& sent, long typesel, long node, const std::vector<long>& left) {
  for (const long type : sent) send_empty(type, mynode());
  flushmsg(typesel, node, -1);
  for (const long type : left) {
    receive_empty(-1);
    expect_equal(infotype(), type);
  }
  expect_equal(iprobe(-1), 0);
}

RULE(flush_by_type, "flushmsg throws away the waiting messages that its typesel selects", "others stay, in their order") {
  if (is_host()) return;
  flush_and_expect({1, 2, 1, 31, 2}, 1, -1, {2, 31, 2});
  flush_and_expect({1, 2, 1, 31, 2}, 0x80000006, -1, {31});
  flush_and_expect({1, 2, 1, 31, 2}, 3, -1, {1, 2, 1, 31, 2});
  flush_and_expect({1, 2, 1, 31, 2}, -1, -1, {});
}

RULE(flush_by_node, "flushmsg throws away messages of one sender, or of all with -1", "those of other senders stay") {
  if (is_host()) {
    send_empty(48, -1);
    send_empty(49, -1);
    for (long node = 0; node < numnodes(); ++node) receive_empty(49);
    return;
  }
  cprobe(49);
  send_empty(48, mynode());
  cprobe(48);
  flushmsg(48, mynode(), 0);
  receive_empty(48);
  expect_equal(infonode(), myhost());
  expect_equal(iprobe(48), 0);
  flushmsg(49, mynode(), 0);
  receive_empty(49);
  expect_equal(infonode(), myhost());
  send_empty(49, myhost());
}

RULE(flush_spares_the_posted, "flushmsg does not touch posted receives, nor what they have got",
     "a receive that is done keeps its message; one that is not gets the next") {
  if (is_host()) return;
  long done = 0, later = 0;
  const long first = irecv(50, &done, sizeof done);
  const long second = irecv(51, &later, sizeof later);
  send_long(50, 1, mynode());
  flushmsg(-1, -1, -1);
  send_long(51, 2, mynode());
  msgwait(first);
  msgwait(second);
  expect_equal(done, 1);
  expect_equal(later, 2);
}

RULE(flush_of_the_reserved, "flushmsg checks its arguments", "EQTYPE, EQNODE, EQPID") {
  REFUSED(EQTYPE, flushmsg, (1'000'000'000, -1, -1), "reserved");
  REFUSED(EQNODE, flushmsg, (-1, numnodes() + 1, -1), "no node");
  REFUSED(EQPID, flushmsg, (-1, -1, 3), "pid 3");
}

}  // namespace
}  // namespace mars::hal::conformance
