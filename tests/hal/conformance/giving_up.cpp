// msgcancel and flushmsg, and message ids that run out.
#include <string>
#include <vector>

#include "hal/nx/nx_messages.h"
#include "tests/hal/conformance/expect.h"
#include "tests/hal/conformance/rules.h"
#include "tests/hal/conformance/talk.h"

namespace mars::conformance {
namespace {

RULE(cancelled_receives,
     "msgcancel of a receive frees its id, and its message goes to the next receive that selects it",
     "nothing is written to the buffer; the id is EQMID") {
  if (is_host()) return;
  long never = -7, next = 0;
  const long cancelled = irecv(40, &never, sizeof never);
  const long posted = irecv(40, &next, sizeof next);
  msgcancel(cancelled);
  send_long(40, 1, mynode());
  msgwait(posted);
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
     "the next receive does not get the second message instead of the first, also if a handler waits") {
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

RULE(cancelled_for_another,
     "a message that a cancelled receive gives back goes to the next posted receive that selects it",
     "the message does not wait while that receive waits") {
  if (is_host()) return;
  long first = 0, second = 0;
  const long mid = irecv(42, &first, sizeof first);
  const long other = irecv(-1, &second, sizeof second);
  send_long(42, 3, mynode());
  msgcancel(mid);
  msgwait(other);
  expect_equal(second, 3);
}

RULE(cancelled_force, "a force message that a cancelled receive gives back goes to the next posted receive of its type",
     "without one it is discarded") {
  if (is_host()) return;
  constexpr long kForce = 1'073'741'824;
  long value = 0;
  const auto post = [&] { return irecv(kForce, &value, sizeof value); };
  const long first = post(), second = post();
  send_long(kForce, 3, mynode());
  send_empty(45, mynode());
  receive_empty(45);  // the one before has come
  msgcancel(first);
  msgwait(second);
  expect_equal(value, 3);
  const long alone = post();
  send_long(kForce, 4, mynode());
  send_empty(45, mynode());
  receive_empty(45);
  msgcancel(alone);
  const long later = post();
  expect_equal(msgdone(later), 0);
  msgcancel(later);
}

RULE(cancelled_sends, "msgcancel of a send frees its id and its buffer",
     "a message that has been sent is not called back") {
  if (is_host()) return;
  for (const std::size_t size : {8, 300'000}) {
    Bytes mine = pattern(size, 4), theirs(size);
    const long mid = isend(44, mine.data(), length_of(mine), next_node(), 0);
    msgcancel(mid);
    mine.assign(size, 0);
    crecv(44, theirs.data(), length_of(theirs));
    expect(theirs == pattern(size, 4), "the message is whole");
    REFUSED(EQMID, msgwait, (mid), "no message id");
  }
}

RULE(cancel_takes_ids, "msgcancel accepts only message ids", "EQMID for a number that was never an id") {
  REFUSED(EQMID, msgcancel, (-1), "no message id -1");
  REFUSED(EQMID, msgcancel, (0x7fffffff), "no message id 2147483647");
}

RULE(ids_run_out, "a process has 65,536 message ids: when all are in use the next call is EQNOMID",
     "ids that are freed can be used again, all of them; the call that failed posted and sent nothing") {
  if (mynode() != 0) return;
  for (int again = 0; again < 2; ++again) {
    std::vector<long> mids = {isend(45, nullptr, 0, 0, 0)};
    receive_empty(45);
    for (long mid; mids.size() < 100'000 && (mid = _irecv(45, nullptr, 0)) >= 0;) mids.push_back(mid);
    expect_equal(mids.size(), 65'536);
    REFUSED(EQNOMID, irecv, (46, nullptr, 0), "message ids");
    REFUSED(EQNOMID, isend, (46, nullptr, 0, 0, 0), "message ids");
    REFUSED(EQNOMID, isendrecv, (46, nullptr, 0, 0, 0, 46, nullptr, 0), "message ids");
    expect_equal(iprobe(46), 0);
    send_long(46, 9, 0);  // that need no id of the program's
    expect_equal(receive_long(46), 9);
    msgwait(mids.front());
    mids.front() = irecv(45, nullptr, 0);
    REFUSED(EQNOMID, irecv, (46, nullptr, 0), "message ids");
    for (; !mids.empty(); mids.pop_back()) msgcancel(mids.back());
  }
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

RULE(flush_by_type, "flushmsg throws away the waiting messages that its typesel selects",
     "others stay, in their order") {
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

RULE(flush_spares_the_posted, "flushmsg changes neither posted receives nor the messages that they have received",
     "a receive that is done keeps its message; a receive that is not done gets the next message") {
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
}  // namespace mars::conformance
