// Wrong arguments. Each is told with the rank, the call, what was wrong and what to do.
#include <string>

#include "hal/nx/nx_messages.h"
#include "tests/hal/conformance/expect.h"
#include "tests/hal/conformance/rules.h"
#include "tests/hal/conformance/talk.h"

namespace mars::hal::conformance {
namespace {

std::string who() { return is_host() ? "the host" : "node " + std::to_string(mynode()); }

RULE(reserved_types, "1000000000 to 1073741823, 2000000000 and up, and negative ones are no types", "EQTYPE") {
  long x = 0;
  expect_fails([&] { csend(1'000'000'000, &x, 8, 0, 0); }, {who(), "csend", "1000000000", "reserved"});
  expect_fails([&] { csend(1'073'741'823, &x, 8, 0, 0); }, {"1073741823", "reserved"});
  expect_fails([&] { csend(-1, &x, 8, 0, 0); }, {"type -1"});
  expect_fails([&] { isend(2'000'000'000, &x, 8, 0, 0); }, {"isend", "2000000000"});
  expect_fails([&] { crecv(1'000'000'001, &x, 8); }, {"crecv", "1000000001", "reserved"});
  expect_fails([&] { irecv(1'073'741'823, &x, 8); }, {"irecv", "1073741823", "reserved"});
  expect_fails([&] { cprobe(2'000'000'001); }, {"cprobe", "reserved"});
  expect_fails([&] { iprobe(2'147'483'647); }, {"iprobe", "reserved"});
}

RULE(no_such_node, "nodes are 0 to numnodes() - 1, myhost() and -1", "EQNODE") {
  long x = 0;
  const long beyond = numnodes() + 1;
  expect_fails([&] { csend(1, &x, 8, beyond, 0); }, {who(), "csend", "no node " + std::to_string(beyond)});
  expect_fails([&] { csend(1, &x, 8, -2, 0); }, {"no node -2"});
  expect_fails([&] { isend(1, &x, 8, 1'000'000, 0); }, {"isend", "no node 1000000"});
}

RULE(no_such_pid, "a node runs one process, pid 0", "EQPID") {
  long x = 0;
  expect_fails([&] { csend(1, &x, 8, 0, 3); }, {who(), "csend", "pid 3"});
  expect_fails([&] { isend(1, &x, 8, 0, -2); }, {"isend", "pid -2"});
}

RULE(negative_lengths, "lengths are not negative", "EQLEN") {
  long x = 0;
  expect_fails([&] { csend(1, &x, -8, 0, 0); }, {who(), "csend", "length -8"});
  expect_fails([&] { isend(1, &x, -1, 0, 0); }, {"isend", "length -1"});
  expect_fails([&] { irecv(1, &x, -1); }, {"irecv", "length -1"});
  expect_fails([&] { crecv(1, &x, -2); }, {"crecv", "length -2"});
}

}  // namespace
}  // namespace mars::hal::conformance
