// Sends: to whom, in which order, and that none waits for its receiver.
#include <algorithm>
#include <vector>

#include "hal/nx/nx_messages.h"
#include "tests/hal/conformance/expect.h"
#include "tests/hal/conformance/rules.h"
#include "tests/hal/conformance/talk.h"

namespace mars::conformance {
namespace {

RULE(round_a_ring, "csend and crecv carry a message; info* give its sender, type, length and pid 0",
     "a message of another node is not received") {
  if (is_host()) return;
  send_long(7, 100 + mynode(), next_node());
  expect_equal(receive_long(7), 100 + previous_node());
  expect_equal(infonode(), previous_node());
  expect_equal(infotype(), 7);
  expect_equal(infocount(), sizeof(long));
  expect_equal(infopid(), 0);
}

RULE(to_oneself, "a rank, the host too, can send to itself", "the message is not lost behind messages of others") {
  send_long(8, 80 + mynode(), mynode());
  expect_equal(receive_long(8), 80 + mynode());
  expect_equal(infonode(), mynode());
}

RULE(to_all_nodes, "csend to node -1 goes to all other nodes", "not to the caller, and not to the host") {
  if (mynode() == 0) send_long(30, 5, -1);
  if (!is_host()) {
    if (mynode() != 0) expect_equal(receive_long(30), 5);
    if (mynode() == 0) send_empty(31, myhost());
  } else {
    receive_empty(31);  // of the same sender, later
    expect_equal(iprobe(30), 0);
  }
  if (mynode() == 0) expect_equal(iprobe(30), 0);
}

RULE(from_the_host_to_all, "csend of the host to node -1 goes to all nodes", "not to the host") {
  if (is_host()) send_long(31, 6, -1);
  if (!is_host()) expect_equal(receive_long(31), 6);
  if (is_host()) expect_equal(iprobe(31), 0);
}

RULE(isend_to_all_nodes, "isend to node -1 is one id and goes to all other nodes", "not to the caller") {
  if (mynode() == 0) {
    long seven = 7;
    msgwait(isend(32, &seven, sizeof seven, -1, 0));
    expect_equal(iprobe(32), 0);
  } else if (!is_host()) {
    expect_equal(receive_long(32), 7);
  }
}

RULE(pairs_keep_their_order, "between one sender and one receiver messages stay in order, whatever their types",
     "no later one is received first by a wildcard") {
  const long messages = numnodes() <= 3 ? 5000 : 500;
  const long sender = numnodes() - 1;
  if (mynode() == sender) {
    for (long i = 0; i < messages; ++i) send_long(i % 3, i, myhost());
  }
  if (!is_host()) return;
  for (long i = 0; i < messages; ++i) {
    expect_equal(receive_long(0x80000007), i);
    expect_equal(infotype(), i % 3);
  }
}

RULE(long_and_short_keep_their_order, "a short message does not overtake a long one, by csend or by isend",
     "a wildcard does not get the short one first") {
  const long longest = numnodes() <= 3 ? 3 << 20 : 300'000;
  const std::vector<long> lengths = {longest, 0, 70000, 8, 5000, 101, 100, longest / 3, 1};
  if (is_host()) return;
  std::vector<Bytes> mine;
  for (const long length : lengths) mine.push_back(pattern(length, 3));
  std::vector<long> mids;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    if (i % 2 == 0)
      mids.push_back(isend(40 + static_cast<long>(i), mine[i].data(), lengths[i], next_node(), 0));
    else
      csend(40 + static_cast<long>(i), mine[i].data(), lengths[i], next_node(), 0);
  }
  Bytes theirs(lengths[0]);
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    crecv(-1, theirs.data(), length_of(theirs));
    expect_equal(infotype(), 40 + i);
    expect_equal(infocount(), lengths[i]);
    expect(std::equal(mine[i].begin(), mine[i].end(), theirs.begin()), "the message is whole");
  }
  for (const long mid : mids) msgwait(mid);
}

RULE(head_to_head, "csend of long messages both ways at once never waits for the receive: 8 MB each way, then crecv",
     "no deadlock, also if all nodes of a larger cube do so with 200 kB") {
  if (is_host()) return;
  const long length = numnodes() <= 3 ? 8'000'000 : 200'000;
  const long other = mynode() ^ 1;
  if (other >= numnodes()) return;
  const Bytes mine = pattern(length, static_cast<std::uint32_t>(mynode()));
  csend(50, mine.data(), length, other, 0);
  Bytes theirs(length);
  crecv(50, theirs.data(), length);
  expect(theirs == pattern(length, static_cast<std::uint32_t>(other)), "the message is whole");
}

RULE(long_to_oneself, "csend of 8 MB to oneself returns before the receive", "no deadlock") {
  if (mynode() != 0 || numnodes() > 3) return;  // it takes time, and has nothing to do with the others
  constexpr long kLength = 8'000'000;
  const Bytes mine = pattern(kLength, 6);
  csend(51, mine.data(), kLength, 0, 0);
  Bytes theirs(kLength);
  crecv(51, theirs.data(), kLength);
  expect(theirs == mine, "the message is whole");
}

RULE(the_buffer_is_free_after_csend, "after csend, and after isend when its id is done, the buffer may be written to",
     "the receiver does not see what is written after that") {
  if (is_host()) return;
  Bytes mine = pattern(300'000, 1);
  csend(52, mine.data(), length_of(mine), next_node(), 0);
  mine.assign(mine.size(), 0);
  Bytes theirs(mine.size());
  crecv(52, theirs.data(), length_of(theirs));
  expect(theirs == pattern(300'000, 1), "the message is whole");
}

RULE(all_to_all, "every rank sends to every rank, long and short", "none is lost, none comes twice") {
  const long ranks = numnodes() + 1;
  const long length = numnodes() <= 8 ? 150'000 : 5'000;
  for (long to = 0; to < ranks; ++to) {
    const Bytes mine = pattern(length, static_cast<std::uint32_t>(mynode() * ranks + to));
    csend(1000 + mynode(), mine.data(), length, to, 0);
    send_empty(2000 + mynode(), to);
  }
  Bytes theirs(length);
  for (long from = ranks - 1; from >= 0; --from) {
    receive_empty(2000 + from);
    crecv(1000 + from, theirs.data(), length);
    expect_equal(infonode(), from);
    expect(theirs == pattern(length, static_cast<std::uint32_t>(from * ranks + mynode())), "the message is whole");
  }
}

}  // namespace
}  // namespace mars::conformance
