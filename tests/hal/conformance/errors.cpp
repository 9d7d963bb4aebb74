// Wrong arguments. The plain call's failure names the rank, the call, the error and the remedy; its twin returns -1 and
// sets errno.
#include <string>

#include "hal/nx/nx_messages.h"
#include "tests/hal/conformance/expect.h"
#include "tests/hal/conformance/rules.h"
#include "tests/hal/conformance/talk.h"

namespace mars::conformance {
namespace {

long x = 0;  // never sent from, never received into

RULE(reserved_types, "1000000000 to 1073741823, 2000000000 and up, and negative numbers are no types: EQTYPE",
     "the numbers next to them are types") {
  REFUSED(EQTYPE, csend, (1'000'000'000, &x, 8, 0, 0), "1000000000", "reserved");
  REFUSED(EQTYPE, csend, (1'073'741'823, &x, 8, 0, 0), "1073741823");
  REFUSED(EQTYPE, csend, (-1, &x, 8, 0, 0), "type -1");
  REFUSED(EQTYPE, csend, (5'000'000'000, &x, 8, 0, 0), "5000000000");
  REFUSED(EQTYPE, isend, (2'000'000'000, &x, 8, 0, 0), "2000000000");
  for (const long good : {0L, 999'999'999L}) {
    send_empty(good, mynode());
    receive_empty(good);
  }
  for (const long good : {1'073'741'824L, 1'999'999'999L}) {  // force
    const long mid = irecv(good, nullptr, 0);
    send_empty(good, mynode());
    msgwait(mid);
    expect_equal(infotype(), good);
  }
}

RULE(reserved_typesels, "a reserved type is no typesel: EQTYPE", "neither for receives nor for probes") {
  REFUSED(EQTYPE, crecv, (1'000'000'000, &x, 8), "1000000000", "reserved");
  REFUSED(EQTYPE, irecv, (1'073'741'823, &x, 8), "1073741823", "reserved");
  REFUSED(EQTYPE, cprobe, (2'000'000'000), "2000000000", "reserved");
  REFUSED(EQTYPE, iprobe, (2'147'483'647), "2147483647", "reserved");
}

RULE(no_such_node, "nodes are 0 to numnodes() - 1, myhost() and -1", "others are EQNODE") {
  const long beyond = numnodes() + 1;
  REFUSED(EQNODE, csend, (1, &x, 8, beyond, 0), "no node " + std::to_string(beyond));
  REFUSED(EQNODE, csend, (1, &x, 8, -2, 0), "no node -2");
  REFUSED(EQNODE, isend, (1, &x, 8, 1'000'000, 0), "no node 1000000");
  REFUSED(EQNODE, isend, (1, &x, 8, 0x100000000, 0), "no node 4294967296");
}

RULE(no_such_pid, "a node runs one process, pid 0", "others are EQPID") {
  REFUSED(EQPID, csend, (1, &x, 8, 0, 3), "pid 3");
  REFUSED(EQPID, isend, (1, &x, 8, 0, -2), "pid -2");
  REFUSED(EQPID, csend, (1, &x, 8, -1, 100), "pid 100");
  REFUSED(EQPID, csend, (1, &x, 8, myhost(), -2), "pid -2");
}

RULE(negative_lengths, "lengths are not negative", "EQLEN") {
  REFUSED(EQLEN, csend, (1, &x, -8, 0, 0), "length -8");
  REFUSED(EQLEN, isend, (1, &x, -1, 0, 0), "length -1");
  REFUSED(EQLEN, irecv, (1, &x, -1), "length -1");
  REFUSED(EQLEN, crecv, (1, &x, -2), "length -2");
}

RULE(null_buffers, "a null pointer is a buffer of no bytes", "with a length above 0 it is EQPBUF") {
  REFUSED(EQPBUF, csend, (1, nullptr, 8, 0, 0), "8 bytes", "null");
  REFUSED(EQPBUF, isend, (1, nullptr, 1, 0, 0), "1 byte", "null");
  REFUSED(EQPBUF, irecv, (1, nullptr, 8), "8 bytes", "null");
  REFUSED(EQPBUF, crecv, (1, nullptr, 8), "8 bytes", "null");
  send_empty(1, mynode());
  msgwait(irecv(1, nullptr, 0));
}

RULE(what_was_refused_did_nothing, "a refused call sends nothing, posts nothing and uses no id",
     "the next message that arrives is that of the next call") {
  if (is_host()) return;
  expect_errno(EQLEN, [] { return _csend(2, &x, -1, next_node(), 0); });
  expect_errno(EQNODE, [] { return _isend(2, &x, 8, -9, 0); });
  expect_errno(EQPBUF, [] { return _irecv(-1, nullptr, 8); });
  const long before = irecv(2, nullptr, 0);
  send_empty(2, next_node());
  msgwait(before);
  expect_equal(infocount(), 0);
}

RULE(twins_return_their_results, "a twin that succeeds returns what its plain call does, or 0", "never -1") {
  long value = 12;
  expect_equal(_csend(1, &value, sizeof value, mynode(), 0), 0);
  expect_equal(_cprobe(1), 0);
  expect_equal(_iprobe(1), 1);
  expect_equal(_iprobe(2), 0);
  value = 0;
  expect_equal(_crecv(1, &value, sizeof value), 0);
  expect_equal(value, 12);
  const long receiving = _irecv(1, &value, sizeof value);
  expect(receiving >= 0, "_irecv returns an id");
  expect_equal(_msgdone(receiving), 0);
  value = 13;
  const long sending = _isend(1, "12345678", 8, mynode(), 0);
  expect(sending >= 0, "_isend returns an id");
  expect_equal(_msgwait(receiving), 0);
  expect_equal(_msgwait(sending), 0);
  expect_equal(_infotype(), infotype());
  expect_equal(_infocount(), 8);
  expect_equal(_infonode(), mynode());
  expect_equal(_infopid(), 0);
  expect_equal(_mynode(), mynode());
  expect_equal(_numnodes(), numnodes());
  expect_equal(_nodedim(), nodedim());
  expect_equal(_myhost(), myhost());
  expect_equal(_mypid(), 0);
  expect_equal(mypid(), 0);
  expect_equal(_led(1), 0);
  expect_equal(_led(0), 0);
  expect_equal(_flick(), 0);
}

}  // namespace
}  // namespace mars::conformance
