// How long messages may be, and receives that are too short.
#include <string>
#include <vector>

#include "hal/nx/nx_messages.h"
#include "tests/hal/conformance/expect.h"
#include "tests/hal/conformance/rules.h"
#include "tests/hal/conformance/talk.h"

namespace mars::conformance {
namespace {

RULE(zero_length, "a message may be empty, and be received into no buffer",
     "its probe and its receive report the length 0") {
  if (is_host()) send_empty(9, -1);
  if (is_host()) return;
  cprobe(9);
  expect_equal(infocount(), 0);
  char untouched = 'x';
  crecv(9, &untouched, 1);
  expect_equal(infocount(), 0);
  expect_equal(infonode(), myhost());
  expect_equal(untouched, 'x');
}

RULE(lengths_about_thresholds, "messages of every length arrive whole, also of about 100, 256, 4096 and 65536 bytes",
     "what lies behind the end of a message stays untouched") {
  const std::vector<long> about = {1, 3, 99, 100, 101, 255, 256, 257, 4095, 4096, 4097, 65535, 65536, 65537};
  if (is_host()) return;
  for (const long length : about) {
    const Bytes mine = pattern(length, static_cast<std::uint32_t>(mynode() + length));
    csend(20, mine.data(), length, next_node(), 0);
  }
  for (const long length : about) {
    Bytes theirs(length + 1, 0xee);
    crecv(20, theirs.data(), length + 1);
    expect_equal(infocount(), length);
    Bytes wanted = pattern(length, static_cast<std::uint32_t>(previous_node() + length));
    wanted.push_back(0xee);
    expect(theirs == wanted, "the message of " + std::to_string(length) + " bytes is whole");
  }
}

RULE(sixty_four_megabytes, "a message of 64 MiB arrives whole, by csend and by isend", "the two do not mix") {
  constexpr std::size_t kLength = 64 << 20;
  if (numnodes() != 2 || (!is_host() && mynode() != 0)) return;  // once is enough: it takes time
  const Bytes wanted = pattern(kLength, 4711);
  if (is_host()) {
    csend(5, wanted.data(), kLength, 0, 0);
    msgwait(isend(6, wanted.data(), kLength, 0, 0));
    return;
  }
  Bytes data(kLength);
  for (const long type : {5L, 6L}) {
    crecv(type, data.data(), kLength);
    expect(data == wanted, "the message is whole");
    data.front() = data.back() = data[kLength / 2] = 0;
  }
}

RULE(too_long_is_no_truncation, "a message longer than the receive's buffer is an error, never cut: EQMSGLONG",
     "the buffer stays untouched, and the message is there for a longer receive") {
  if (is_host()) {
    const Bytes data = pattern(200, 2);
    csend(70, data.data(), 200, -1, 0);
    return;
  }
  Bytes data(200, 0xee);
  for (int look = 0; look < 2; ++look) {  // as it arrives, and as it waits
    REFUSED(EQMSGLONG, crecv, (70, data.data(), 199), "200 bytes", "199 bytes", "type 70", "from the host");
    expect(data == Bytes(200, 0xee), "the buffer is untouched");
    expect_equal(iprobe(71), 0);
  }
  expect_equal(iprobe(70), 1);
  crecv(70, data.data(), 200);
  expect(data == pattern(200, 2), "the message is whole");
}

RULE(too_long_after_shorter, "a receive that is too short for the first message does not take a later one that fits",
     "the order of the two stays") {
  if (is_host()) {
    send_long(72, 1, -1);
    send_empty(72, -1);
    return;
  }
  REFUSED(EQMSGLONG, crecv, (72, nullptr, 0), "8 bytes", "0 bytes");
  expect_equal(receive_long(72), 1);
  receive_empty(72);
}

RULE(too_long_for_the_posted,
     "a posted receive that is too short fails at its msgwait or msgdone, and the message goes on",
     "EQMSGLONG not before that; its buffer stays untouched; the next receive gets the message") {
  if (is_host()) return;
  long untouched = -7, also = -7, value = 0;
  const long waited = irecv(73, &untouched, 7);
  const long asked = irecv(-1, &also, 4);
  const long fits = irecv(73, &value, sizeof value);
  send_long(73, 5, mynode());
  msgwait(fits);
  expect_equal(value, 5);
  expect_errno(EQMSGLONG, [&] { return _msgwait(waited); });
  expect_errno(EQMSGLONG, [&] { return _msgdone(asked); });
  expect_errno(EQMID, [&] { return _msgdone(asked); });
  expect_equal(untouched, -7);
  expect_equal(also, -7);
}

RULE(too_long_for_all_posted, "a message too long for every posted receive that selects it waits",
     "a longer receive gets it") {
  if (is_host()) return;
  char small[4] = "abc";
  const long mid = irecv(75, small, 4);
  send_long(75, 10, mynode());
  expect_errno(EQMSGLONG, [&] { return _msgwait(mid); });
  expect_equal(std::string(small), "abc");
  expect_equal(receive_long(75), 10);
}

RULE(too_long_for_an_irecv, "irecv of a message that waits and is too long fails at its msgwait",
     "the message goes on waiting") {
  if (is_host()) return;
  long value = 0;
  send_long(74, 6, mynode());
  cprobe(74);
  const long mid = irecv(74, &value, 4);
  expect_fails(EQMSGLONG, [&] { msgwait(mid); }, {"irecv", "8 bytes", "4 bytes", "type 74"});
  expect_equal(value, 0);
  expect_equal(receive_long(74), 6);
}

}  // namespace
}  // namespace mars::conformance
