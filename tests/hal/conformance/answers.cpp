// csendrecv and isendrecv: a message and its answer.
#include "hal/nx/nx_messages.h"
#include "tests/hal/conformance/expect.h"
#include "tests/hal/conformance/rules.h"
#include "tests/hal/conformance/talk.h"

namespace mars::conformance {
namespace {

// The host answers each node's question twice over, one byte longer each time.
void answer_all(int times) {
  for (long i = 0; i < times * numnodes(); ++i) {
    const long question = receive_long(60);
    const long answer[2] = {2 * question, 0};
    csend(61, answer, sizeof(long) + 1, infonode(), 0);
  }
}

RULE(csendrecv_returns_the_length, "csendrecv sends, waits for the answer and returns its length",
     "info* describe the answer") {
  if (is_host()) {
    answer_all(3);
    return;
  }
  for (long question = 0; question < 3; ++question) {
    long answer[2] = {};
    expect_equal(csendrecv(60, &question, sizeof question, myhost(), 0, 61, answer, sizeof answer), sizeof(long) + 1);
    expect_equal(answer[0], 2 * question);
    expect_equal(infotype(), 61);
    expect_equal(infonode(), myhost());
    expect_equal(infocount(), sizeof(long) + 1);
  }
}

RULE(csendrecv_round_a_ring, "all nodes may csendrecv at once, long messages too", "no deadlock") {
  if (is_host()) return;
  const long length = numnodes() <= 3 ? 2'000'000 : 200'000;
  const Bytes mine = pattern(static_cast<std::size_t>(length), static_cast<std::uint32_t>(mynode()));
  Bytes theirs(mine.size());
  expect_equal(csendrecv(62, mine.data(), length, next_node(), 0, 62, theirs.data(), length), length);
  expect(theirs == pattern(theirs.size(), static_cast<std::uint32_t>(previous_node())), "the message is whole");
}

RULE(csendrecv_takes_what_waits, "csendrecv takes an earlier message that its typesel selects for the answer",
     "it cannot know to which message an answer belongs") {
  if (is_host()) return;
  long answer = 0, question = 5;
  send_long(63, 1, mynode());
  cprobe(63);
  expect_equal(csendrecv(64, &question, sizeof question, mynode(), 0, 63, &answer, sizeof answer), sizeof answer);
  expect_equal(answer, 1);
  expect_equal(receive_long(64), 5);
}

RULE(isendrecv_is_one_id, "isendrecv is one id, done when the answer is there", "before that, msgdone is 0") {
  if (is_host()) {
    for (long node = 0; node < numnodes(); ++node) receive_empty(65);
    answer_all(1);
    return;
  }
  long question = 10 + mynode(), answer[2] = {};
  const long mid = isendrecv(60, &question, sizeof question, myhost(), 0, 61, answer, sizeof answer);
  expect_equal(msgdone(mid), 0);
  send_empty(65, myhost());
  msgwait(mid);
  expect_equal(infocount(), sizeof(long) + 1);
  expect_equal(infotype(), 61);
  expect_equal(answer[0], 2 * question);
  REFUSED(EQMID, msgwait, (mid), "no message id");
}

RULE(wrong_arguments_of_answers, "both parts of csendrecv and isendrecv are checked before anything is sent",
     "EQTYPE, EQNODE, EQPID, EQLEN, EQPBUF, and nothing has been sent") {
  long x = 0;
  REFUSED(EQTYPE, csendrecv, (1'000'000'000, &x, 8, mynode(), 0, 1, &x, 8), "1000000000");
  REFUSED(EQTYPE, csendrecv, (1, &x, 8, mynode(), 0, 1'000'000'001, &x, 8), "1000000001");
  REFUSED(EQNODE, csendrecv, (1, &x, 8, numnodes() + 1, 0, 1, &x, 8), "no node");
  REFUSED(EQPID, csendrecv, (1, &x, 8, 0, 1, 1, &x, 8), "pid 1");
  REFUSED(EQLEN, csendrecv, (1, &x, 8, mynode(), 0, 1, &x, -8), "length -8");
  REFUSED(EQPBUF, csendrecv, (1, &x, 8, mynode(), 0, 1, nullptr, 8), "null");
  REFUSED(EQTYPE, isendrecv, (1, &x, 8, mynode(), 0, 1'000'000'001, &x, 8), "1000000001");
  REFUSED(EQLEN, isendrecv, (1, &x, 8, mynode(), 0, 1, &x, -8), "length -8");
  REFUSED(EQPBUF, isendrecv, (1, nullptr, 8, mynode(), 0, 1, &x, 8), "null");
  REFUSED(EQNODE, isendrecv, (1, &x, 8, -3, 0, 1, &x, 8), "no node -3");
  expect_equal(iprobe(1), 0);
}

RULE(answers_too_long, "an answer longer than the buffer is EQMSGLONG", "a longer receive can still get it") {
  if (is_host()) {
    answer_all(1);
    return;
  }
  long question = 3, answer[2] = {-1, -1};
  expect_errno(EQMSGLONG, [&] { return _csendrecv(60, &question, sizeof question, myhost(), 0, 61, answer, 8); });
  expect_equal(answer[0], -1);
  crecv(61, answer, sizeof answer);
  expect_equal(answer[0], 6);
}

RULE(answers_that_wait_too_long,
     "an answer that waits already and is too long fails csendrecv, and isendrecv at its msgwait",
     "EQMSGLONG each time; the answer goes on waiting, and the messages have been sent") {
  if (is_host()) return;
  char in = 'x';
  send_long(66, 1, mynode());
  cprobe(66);
  for (int look = 0; look < 2; ++look) {
    expect_errno(EQMSGLONG, [&] { return _csendrecv(67, "?", 1, mynode(), 0, 66, &in, 1); });
    const long mid = isendrecv(67, "?", 1, mynode(), 0, 66, &in, 1);
    expect_errno(EQMSGLONG, [&] { return _msgwait(mid); });
  }
  expect_equal(in, 'x');
  expect_equal(receive_long(66), 1);
  for (int question = 0; question < 4; ++question) crecv(67, &in, 1);
}

}  // namespace
}  // namespace mars::conformance
