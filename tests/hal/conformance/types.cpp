// Which types there are and which of them a typesel selects.
#include <vector>

#include "hal/nx/nx_messages.h"
#include "tests/hal/conformance/expect.h"
#include "tests/hal/conformance/rules.h"
#include "tests/hal/conformance/talk.h"

namespace mars::conformance {
namespace {

constexpr long kForce = 1'073'741'824;

// The host sends each node an empty message of each type; the node receives with each typesel in turn, and what comes
// is of the type next to it.
struct Step {
  long typesel;
  long type;
};

void select_in_turn(const std::vector<long>& sent, const std::vector<Step>& steps) {
  if (is_host()) {
    for (const long type : sent) send_empty(type, -1);
    return;
  }
  cprobe(sent.back());  // all are there
  for (const Step& step : steps) {
    receive_empty(step.typesel);
    expect_equal(infotype(), step.type);
  }
}

RULE(an_exact_type, "a typesel of 0 or more selects that type alone", "other types stay, and in their order") {
  select_in_turn({3, 2, 999'999'999, 0, 2}, {{0, 0}, {999'999'999, 999'999'999}, {2, 2}, {2, 2}, {3, 3}});
}

RULE(minus_one, "typesel -1 selects the first message of any ordinary type", "it does not sort by type") {
  select_in_turn({5, 0, 999'999'999, 29, 30}, {{-1, 5}, {-1, 0}, {-1, 999'999'999}, {-1, 29}, {-1, 30}});
}

RULE(low_bits, "any other negative typesel is a set: bit k, 0 to 29, selects type k",
     "types whose bits are not set stay") {
  select_in_turn({29, 1, 30, 0, 16}, {{-0x80000000L | 1 << 16 | 1, 0},
                                      {-0x80000000L | 1 << 16 | 1, 16},
                                      {-0x80000000L | 1 << 29 | 1 << 1, 29},
                                      {-0x80000000L | 1 << 29 | 1 << 1, 1},
                                      {-1, 30}});
}

RULE(bit_30, "bit 30 of a set selects all types from 30 to 999999999",
     "bit 30 does not select type 29, and bit 29 not type 30") {
  select_in_turn({29, 30, 29, 999'999'999, 31}, {{-0x80000000L | 1 << 30, 30},
                                                 {-0x80000000L | 1 << 30, 999'999'999},
                                                 {-0x80000000L | 1 << 29, 29},
                                                 {-0x80000000L | 1 << 30, 31},
                                                 {-1, 29}});
}

RULE(positive_sets,
     "only the lower 32 bits of a typesel count: 0x80000007, positive as a long of 64, selects types 0, 1 and 2",
     "type 3 stays") {
  select_in_turn({3, 2, 0, 1, 31, 7},
                 {{0x80000007, 2}, {0x80000007, 0}, {0x80000007, 1}, {0xc0000000, 31}, {0xffffffff, 3}, {-1, 7}});
}

RULE(sets_do_not_probe_others, "iprobe accepts a set as receives do",
     "0 if only messages of types outside the set wait") {
  if (is_host()) send_empty(4, -1);
  if (is_host()) return;
  cprobe(4);
  expect_equal(iprobe(0x8000000f), 0);
  expect_equal(iprobe(0x80000010), 1);
  receive_empty(0x80000010);
  expect_equal(infotype(), 4);
}

RULE(force_is_discarded, "a force message is discarded if no receive is posted for it",
     "a receive posted later does not get it; iprobe finds none, and cprobe, which would wait for ever, is EQTYPE") {
  if (is_host()) {
    send_empty(kForce, -1);
    send_empty(1, -1);
    for (long node = 0; node < numnodes(); ++node) receive_empty(2);
    send_long(kForce, 3, -1);
    send_empty(1, -1);
    return;
  }
  receive_empty(1);
  expect_equal(iprobe(kForce), 0);
  REFUSED(EQTYPE, cprobe, (kForce), "force");
  long forced = 0;
  const long mid = irecv(kForce, &forced, sizeof forced);
  expect_equal(msgdone(mid), 0);
  send_empty(2, myhost());
  receive_empty(1);
  msgwait(mid);
  expect_equal(forced, 3);
  expect_equal(infotype(), kForce);
  expect_equal(infonode(), myhost());
}

RULE(force_is_not_ordinary, "no wildcard selects a force message: a posted receive of -1 or of all bits lets it pass",
     "it is discarded although they are posted") {
  if (is_host()) {
    for (long node = 0; node < numnodes(); ++node) receive_empty(2);
    send_empty(1'999'999'999, -1);
    send_empty(kForce, -1);
    send_empty(1, -1);
    send_empty(4, -1);
    return;
  }
  const long any = irecv(-1, nullptr, 0);
  const long set = irecv(-0x80000000L | 1 << 30 | 1 << 4, nullptr, 0);
  send_empty(2, myhost());
  msgwait(any);
  expect_equal(infotype(), 1);
  msgwait(set);
  expect_equal(infotype(), 4);
}

RULE(force_is_awaited, "crecv of a force type is a posted receive: it takes the message that comes while it waits",
     "a message that comes before or after is discarded, so the host sends until all have one") {
  constexpr long kOften = kForce + 7;
  if (!is_host()) {
    expect_equal(receive_long(kOften), 5);
    expect_equal(infotype(), kOften);
    send_empty(3, myhost());
    return;
  }
  for (long awaited = numnodes(); awaited > 0;) {
    send_long(kOften, 5, -1);
    for (; awaited > 0 && iprobe(3) == 1; --awaited) receive_empty(3);
    flick();
  }
}

}  // namespace
}  // namespace mars::conformance
