// The Paragon's forms: receives that choose the sender, arrays of information, ids made one, ids forgotten.
#include <array>
#include <vector>

#include "hal/nx/nx_messages.h"
#include "hal/nx/nx_paragon.h"
#include "tests/hal/conformance/expect.h"
#include "tests/hal/conformance/rules.h"
#include "tests/hal/conformance/talk.h"

namespace mars::conformance {
namespace {

using Info = std::array<long, 8>;

RULE(crecvx_by_sender, "crecvx receives from the node that it names; -1 is any node",
     "an earlier message of another sender stays") {
  if (!is_host()) {
    send_long(80, 100 + mynode(), myhost());
    return;
  }
  for (long node = numnodes() - 1; node >= 0; --node) {
    Info info;
    info.fill(-7);
    long value = 0;
    crecvx(80, &value, sizeof value, node, 0, info.data());
    expect_equal(value, 100 + node);
    expect(info == Info{80, sizeof(long), node}, "the array describes the message");
    expect_equal(infonode(), node);
    expect_equal(infoptype(), 0);
  }
}

RULE(irecvx_by_sender, "irecvx receives from the node that it names, too; its array is filled when the id is done",
     "not before, and not by a message of another node") {
  if (is_host()) {
    send_long(81, 1, -1);
    return;
  }
  long own = 0, hosts = 0;
  Info info;
  info.fill(-7);
  const long from_me = irecvx(81, &own, sizeof own, mynode(), -1, info.data());
  const long from_host = irecvx(-1, &hosts, sizeof hosts, myhost(), -1, nullptr);
  msgwait(from_host);
  expect_equal(hosts, 1);
  expect_equal(msgdone(from_me), 0);
  expect_equal(info[0], -7);
  send_long(81, 2, mynode());
  msgwait(from_me);
  expect_equal(own, 2);
  expect(info == Info{81, sizeof(long), mynode()}, "the array describes the message");
}

RULE(probes_by_sender, "cprobex and iprobex find messages of the node that they name",
     "0 if only messages of other nodes wait") {
  if (is_host()) send_long(82, 1, -1);
  if (is_host()) return;
  Info info = {};
  cprobex(82, myhost(), -1, info.data());
  expect(info == Info{82, sizeof(long), myhost()}, "the array describes the message");
  expect_equal(iprobex(82, mynode(), -1, info.data()), 0);
  expect_equal(iprobex(82, myhost(), 0, nullptr), 1);
  receive_long(82);
}

RULE(merged_ids,
     "msgmerge makes one id of two, which is done when both are, and frees the other; merging with -1 changes nothing",
     "it is not done with one of them, and the other id is EQMID") {
  if (is_host()) return;
  long first = 0, second = 0;
  const long one = irecv(83, &first, sizeof first);
  const long two = irecv(84, &second, sizeof second);
  expect_equal(msgmerge(-1, one), one);
  expect_equal(msgmerge(one, -1), one);
  const long both = msgmerge(one, two);
  send_long(84, 2, mynode());
  expect_equal(msgdone(both), 0);
  expect_equal(msgdone(both), 0);
  send_long(83, 1, mynode());
  msgwait(both);
  expect_equal(first, 1);
  expect_equal(second, 2);
  expect_equal(infotype(), 83);  // of the first receive among them
  REFUSED(EQMID, msgwait, (one), "no message id");
  REFUSED(EQMID, msgwait, (two), "no message id");
}

RULE(wrong_merges, "msgmerge takes two ids in use", "EQMID for other numbers, and for the same id twice") {
  const long mid = irecv(85, nullptr, 0);
  REFUSED(EQMID, msgmerge, (mid, 0x7fffffff), "no message id");
  REFUSED(EQMID, msgmerge, (mid, mid), "message ids");
  expect_equal(msgdone(mid), 0);  // the id is as it was
  msgcancel(mid);
}

RULE(ignored_ids, "msgignore frees the id, and its send or receive goes on",
     "the message does not wait for another receive") {
  if (is_host()) return;
  long value = 0;
  const long mid = irecv(86, &value, sizeof value);
  msgignore(mid);
  REFUSED(EQMID, msgdone, (mid), "no message id");
  send_long(86, 3, mynode());
  send_empty(87, mynode());
  receive_empty(87);  // the one before has come
  expect_equal(iprobe(86), 0);
  expect_equal(value, 3);
  expect_equal(infotype(), 87);
}

std::vector<long>& parameters() {
  static std::array<std::vector<long>, 128> of_rank;
  return of_rank.at(static_cast<std::size_t>(mynode()));
}

void note_parameter(long type, long len, long node, long ptype, long parameter) {
  if (ptype == 0 && len == 0 && node == mynode()) parameters().push_back(1000 * type + parameter);
}

RULE(handlers_with_a_parameter, "hrecvx and hsendx give their parameter to the handler", "each handler gets its own") {
  if (is_host()) return;
  parameters().clear();
  masktrap(1);
  hrecvx(88, nullptr, 0, mynode(), -1, note_parameter, 5);
  hrecvx(89, nullptr, 0, -1, -1, note_parameter, 6);
  send_empty(88, mynode());
  send_empty(89, mynode());
  masktrap(0);
  for (const double end = dclock() + 20; parameters().size() < 2 && dclock() < end;) flick();
  hsendx(90, nullptr, 0, mynode(), 0, note_parameter, 7);
  for (const double end = dclock() + 20; parameters().size() < 3 && dclock() < end;) flick();
  receive_empty(90);
  expect(parameters() == std::vector<long>{88'005, 89'006, 90'007}, "each handler got its own");
}

RULE(wrong_arguments_of_forms_with_x, "calls with x check what those without x check, and the sender that they name",
     "EQTYPE, EQNODE, EQPID, EQLEN, EQPBUF") {
  long x = 0;
  REFUSED(EQTYPE, crecvx, (1'000'000'000, &x, 8, -1, -1, nullptr), "reserved");
  REFUSED(EQNODE, crecvx, (1, &x, 8, numnodes() + 1, -1, nullptr), "no node");
  REFUSED(EQPID, irecvx, (1, &x, 8, -1, 4, nullptr), "4");
  REFUSED(EQLEN, irecvx, (1, &x, -8, -1, -1, nullptr), "length -8");
  REFUSED(EQPBUF, irecvx, (1, nullptr, 8, -1, -1, nullptr), "null");
  REFUSED(EQNODE, cprobex, (1, -2, -1, nullptr), "no node -2");
  REFUSED(EQTYPE, iprobex, (2'000'000'000, -1, -1, nullptr), "reserved");
  expect_equal(myptype(), 0);
  setptype(0);
  REFUSED(EQPID, setptype, (1), "1");
}

}  // namespace
}  // namespace mars::conformance
