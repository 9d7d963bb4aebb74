// Ids of nodes, the host among the ranks, neighbours in the cube.
#include <set>

#include "hal/nx/nx_global.h"
#include "hal/nx/nx_messages.h"
#include "tests/hal/conformance/expect.h"
#include "tests/hal/conformance/rules.h"
#include "tests/hal/conformance/talk.h"

namespace mars::conformance {
namespace {

RULE(numbers_of_ranks, "nodes are 0 to numnodes() - 1; myhost() is none of them; 2^nodedim() is enough for all",
     "one dimension less is not") {
  expect(myhost() < 0 || myhost() >= numnodes(), "the host is no node");
  expect(is_host() || (mynode() >= 0 && mynode() < numnodes()), "a node's id is one of the nodes'");
  expect(1L << nodedim() >= numnodes(), "all nodes are in the cube");
  expect(numnodes() == 1 || 1L << (nodedim() - 1) < numnodes(), "the cube is the smallest");
}

RULE(every_node_is_one, "each id belongs to one node", "otherwise the sum of the ids would differ") {
  if (!is_host()) {
    send_long(5, mynode(), myhost());
    return;
  }
  long sum = 0;
  for (long node = 0; node < numnodes(); ++node) {
    const long id = receive_long(5);
    expect_equal(infonode(), id);
    sum += id;
  }
  expect_equal(sum, numnodes() * (numnodes() - 1) / 2);
}

RULE(the_host_talks_with_every_node, "the host and each node send to each other by id",
     "no node gets a message for another node") {
  if (!is_host()) {
    send_long(20 + mynode(), receive_long(100 + mynode()) * 2, myhost());
    expect_equal(infonode(), myhost());
    return;
  }
  for (long node = 0; node < numnodes(); ++node) send_long(100 + node, 1000 + node, node);
  for (long node = 0; node < numnodes(); ++node) expect_equal(receive_long(20 + node), 2000 + 2 * node);
}

RULE(gray_codes, "gray(n) and gray(n + 1) are neighbours in the cube, and ginv is the inverse of gray",
     "no two n have the same code; the last and the first of 2^d are neighbours too") {
  for (const long size : {2L, 8L, 32L, 1024L}) {
    std::set<long> codes;
    for (long n = 0; n < size; ++n) {
      expect_equal(ginv(gray(n)), n);
      expect(gray(n) >= 0 && gray(n) < size, "the code is a node of the cube");
      codes.insert(gray(n));
      const long change = gray(n) ^ gray((n + 1) % size);
      expect(change != 0 && (change & (change - 1)) == 0, "one bit changes");
    }
    expect_equal(codes.size(), size);
  }
}

RULE(the_host_takes_no_part, "only nodes take part in global operations", "if the host calls one, it is EQNODE") {
  if (!is_host()) {
    gsync();
    return;
  }
  double x = 0, work = 0;
  long count = 0;
  const long length = sizeof x;
  REFUSED(EQNODE, gsync, (), "no part");
  REFUSED(EQNODE, gdsum, (&x, 1, &work), "no part");
  REFUSED(EQNODE, gcol, (&x, length, &x, length, &count), "no part");
  REFUSED(EQNODE, gcolx, (&x, &length, &x), "no part");
}

}  // namespace
}  // namespace mars::conformance
