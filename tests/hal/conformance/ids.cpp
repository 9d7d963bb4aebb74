// Asynchronous sends and receives, and the message ids that stand for them.
#include <numeric>
#include <string>
#include <vector>

#include "hal/nx/nx_messages.h"
#include "tests/hal/conformance/expect.h"
#include "tests/hal/conformance/rules.h"
#include "tests/hal/conformance/talk.h"

namespace mars::conformance {
namespace {

RULE(first_posted_first_served, "a message goes to the first posted receive that selects it",
     "a later receive of its exact type does not come before an earlier wildcard") {
  if (is_host()) {
    for (long node = 0; node < numnodes(); ++node) receive_empty(4);
    send_long(40, 1, -1);
    send_long(41, 2, -1);
    send_long(40, 3, -1);
    return;
  }
  long first = 0, second = 0, third = 0;
  const long any = irecv(-1, &first, sizeof first);
  const long forty = irecv(40, &second, sizeof second);
  const long later = irecv(-1, &third, sizeof third);
  send_empty(4, myhost());
  msgwait(later);
  expect_equal(infotype(), 41);
  msgwait(any);
  expect_equal(infotype(), 40);
  msgwait(forty);
  expect_equal(infotype(), 40);
  expect_equal(first, 1);
  expect_equal(second, 3);
  expect_equal(third, 2);
}

RULE(posted_before_blocking, "a posted receive comes before a crecv called later", "crecv gets the second message") {
  if (is_host()) {
    for (long node = 0; node < numnodes(); ++node) receive_empty(4);
    send_long(42, 1, -1);
    send_long(42, 2, -1);
    return;
  }
  long posted = 0;
  const long mid = irecv(-1, &posted, sizeof posted);
  send_empty(4, myhost());
  expect_equal(receive_long(42), 2);
  msgwait(mid);
  expect_equal(posted, 1);
}

RULE(ids_end_once_done, "msgwait, and a msgdone that returns 1, free the id", "using it again is EQMID") {
  if (is_host()) return;
  const Bytes out = pattern(400'000, 1);
  Bytes in(out.size());
  const long sending = isend(50, out.data(), length_of(out), next_node(), 0);
  const long receiving = irecv(50, in.data(), length_of(in));
  expect(sending >= 0 && receiving >= 0 && sending != receiving, "ids are numbers of their own");
  while (msgdone(receiving) == 0) flick();
  expect(in == out, "the message is whole");
  expect_equal(infocount(), length_of(in));
  msgwait(sending);
  for (const long gone : {sending, receiving, -1L, 0x7fffffffL}) {
    REFUSED(EQMID, msgwait, (gone), "no message id " + std::to_string(gone));
    REFUSED(EQMID, msgdone, (gone), "no message id " + std::to_string(gone));
  }
}

RULE(ids_are_not_used_again_soon, "an id that was freed stands for nothing, even after other ids have been given out",
     "it does not stand for a later receive") {
  if (is_host()) return;
  const long freed = irecv(44, nullptr, 0);
  msgcancel(freed);
  std::vector<long> later;
  for (int i = 0; i < 100; ++i) later.push_back(irecv(44, nullptr, 0));
  REFUSED(EQMID, msgdone, (freed), "no message id " + std::to_string(freed));
  for (const long mid : later) msgcancel(mid);
}

RULE(msgdone_does_not_wait, "msgdone is 0 while no message has come, and the id stays in use",
     "such an id can still be used") {
  if (is_host()) {
    for (long node = 0; node < numnodes(); ++node) receive_empty(4);
    send_long(43, 7, -1);
    return;
  }
  long value = 0;
  const long mid = irecv(43, &value, sizeof value);
  for (int look = 0; look < 3; ++look) expect_equal(msgdone(mid), 0);
  send_empty(4, myhost());
  msgwait(mid);
  expect_equal(value, 7);
}

RULE(a_thousand_ids, "a thousand ids at once, done in any order", "none stands for another's message") {
  constexpr int kIds = 1000;
  if (mynode() == 0) {
    std::vector<long> values(kIds), mids;
    for (int i = 0; i < kIds; ++i) mids.push_back(irecv(100 + i, &values[i], sizeof values[i]));
    send_empty(3, myhost());
    for (int i = kIds - 1; i >= 0; --i) {
      msgwait(mids[i]);
      expect_equal(infotype(), 100 + i);
    }
    for (int i = 0; i < kIds; ++i) expect_equal(values[i], i);
  }
  if (!is_host()) return;
  receive_empty(3);
  std::vector<long> values(kIds), mids;
  std::iota(values.begin(), values.end(), 0);
  for (int i = 0; i < kIds; ++i) mids.push_back(isend(100 + i, &values[i], sizeof values[i], 0, 0));
  for (const long mid : mids) msgwait(mid);
}

RULE(info_is_of_what_was_asked,
     "info* describe the message of the last msgwait, msgdone that returned 1, receive or probe",
     "messages that arrive meanwhile, and sends, do not change them") {
  if (is_host()) return;
  long first = 0, second = 0;
  const long one = irecv(60, &first, sizeof first);
  const long two = irecv(61, &second, 4);
  send_long(60, 1, next_node());
  csend(61, "abc", 3, next_node(), 0);
  msgwait(two);
  expect_equal(infotype(), 61);
  expect_equal(infocount(), 3);
  const long sending = isend(62, nullptr, 0, next_node(), 0);
  msgwait(sending);
  expect_equal(infotype(), 61);
  msgwait(one);
  expect_equal(infotype(), 60);
  expect_equal(infocount(), sizeof(long));
  receive_empty(62);
  expect_equal(infotype(), 62);
}

}  // namespace
}  // namespace mars::conformance
