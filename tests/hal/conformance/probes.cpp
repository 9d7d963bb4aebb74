// cprobe and iprobe.
#include "hal/nx/nx_messages.h"
#include "tests/hal/conformance/expect.h"
#include "tests/hal/conformance/rules.h"
#include "tests/hal/conformance/talk.h"

namespace mars::conformance {
namespace {

RULE(probes_describe, "a probe sets info* to the first pending message that it selects",
     "it does not take the message") {
  const Bytes data = pattern(4000, 3);
  if (is_host()) {
    csend(60, data.data(), 4000, -1, 0);
    csend(61, data.data(), 400, -1, 0);
    return;
  }
  cprobe(61);
  expect_equal(infocount(), 400);
  expect_equal(infotype(), 61);
  for (int again = 0; again < 2; ++again) {
    expect_equal(iprobe(-1), 1);
    expect_equal(infotype(), 60);
    expect_equal(infocount(), 4000);
    expect_equal(infonode(), myhost());
    expect_equal(infopid(), 0);
  }
  Bytes got(4000);
  crecv(60, got.data(), 4000);
  expect(got == data, "the message is whole");
  crecv(61, got.data(), 4000);
  expect_equal(infocount(), 400);
}

RULE(iprobe_does_not_wait, "iprobe is 0 if it finds no message", "info* stay as they were") {
  if (is_host()) send_long(62, 1, -1);
  if (is_host()) return;
  receive_long(62);
  expect_equal(iprobe(62), 0);
  expect_equal(iprobe(-1), 0);
  expect_equal(infotype(), 62);
  expect_equal(infocount(), sizeof(long));
}

RULE(cprobe_waits, "cprobe waits until a message that it selects has come", "other messages do not end the wait") {
  if (is_host()) {
    send_empty(63, -1);
    let_pass(0.002);
    send_empty(64, -1);
    return;
  }
  cprobe(64);
  expect_equal(infotype(), 64);
  receive_empty(-1);
  expect_equal(infotype(), 63);
  receive_empty(-1);
  expect_equal(infotype(), 64);
}

RULE(posted_receives_come_before_probes, "a probe does not see a message that a posted receive takes",
     "iprobe of its type is 0") {
  if (is_host()) {
    for (long node = 0; node < numnodes(); ++node) receive_empty(4);
    send_long(65, 1, -1);
    send_empty(66, -1);
    return;
  }
  long value = 0;
  const long mid = irecv(65, &value, sizeof value);
  send_empty(4, myhost());
  cprobe(66);
  expect_equal(iprobe(65), 0);
  receive_empty(66);
  msgwait(mid);
  expect_equal(value, 1);
}

RULE(the_probed_is_received, "the receive after a probe gets the message that the probe found",
     "also while other ranks send to the same rank") {
  constexpr int kMessages = 50;
  if (!is_host()) {
    for (int i = 0; i < kMessages; ++i) csend(67, pattern(100 * i, 1).data(), 100 * i, myhost(), 0);
    return;
  }
  Bytes buffer(100 * kMessages);
  for (long i = 0; i < kMessages * numnodes(); ++i) {
    cprobe(67);
    const long node = infonode(), count = infocount();
    crecv(67, buffer.data(), length_of(buffer));
    expect_equal(infonode(), node);
    expect_equal(infocount(), count);
  }
}

}  // namespace
}  // namespace mars::conformance
