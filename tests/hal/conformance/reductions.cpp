// Every reduction by name, gopf, and gsendx.
#include <vector>

#include "hal/messages/collective_method.h"
#include "hal/messages/process.h"
#include "hal/nx/nx_global.h"
#include "hal/nx/nx_messages.h"
#include "tests/hal/conformance/expect.h"
#include "tests/hal/conformance/rules.h"
#include "tests/hal/conformance/talk.h"

namespace mars::conformance {
namespace {

template <class T>
using Fold = T (*)(T, T);

// Small whole numbers, so that all arithmetic is exact; some are 0.
template <class T>
T value(long node, long i) {
  return static_cast<T>((node * 7 + i * 3) % 4 - (i % 2));
}

// For products: a product of numbers as large as those of value() would overflow.
template <class T>
T factor(long node, long i) {
  return static_cast<T>((node + i) % 5 == 0 ? -2 : 1);
}

// What the values of i repeat after.
constexpr long kPeriod = 20;

// Short vectors go whole across each dimension, long ones in parts, and odd ones do not halve evenly.
std::vector<long> lengths() {
  if (numnodes() <= 8) return {0, 1, 3, 2160, 17'001};
  return {0, 1, 3, 500};
}

// On every node, at several lengths, `call` gives what `fold` gives of all nodes' values in any order.
template <class T>
void expect_folded(void (*call)(T*, long, T*), T (*of)(long, long), Fold<T> fold, const Place& at = Place::current()) {
  if (is_host()) return;
  std::vector<T> mine, wanted;
  for (long i = 0; i < kPeriod; ++i) {
    mine.push_back(of(mynode(), i));
    wanted.push_back(of(0, i));
    for (long node = 1; node < numnodes(); ++node) wanted.back() = fold(wanted.back(), of(node, i));
  }
  for (const long length : lengths()) {
    std::vector<T> x(static_cast<std::size_t>(length)), work(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = mine[i % kPeriod];
    call(x.data(), length, work.data());
    for (std::size_t i = 0; i < x.size(); ++i) expect_equal(x[i], wanted[i % kPeriod], at);
  }
}

template <class T>
T sum(T a, T b) {
  return a + b;
}
template <class T>
T product(T a, T b) {
  return a * b;
}
template <class T>
T high(T a, T b) {
  return a < b ? b : a;
}
template <class T>
T low(T a, T b) {
  return b < a ? b : a;
}

void reduce_doubles() {
  expect_folded<double>(gdsum, value, sum);
  expect_folded<double>(gdprod, factor, product);
  expect_folded<double>(gdhigh, value, high);
  expect_folded<double>(gdlow, value, low);
}

void reduce_floats() {
  expect_folded<float>(gssum, value, sum);
  expect_folded<float>(gsprod, factor, product);
  expect_folded<float>(gshigh, value, high);
  expect_folded<float>(gslow, value, low);
}

void reduce_longs() {
  expect_folded<long>(gisum, value, sum);
  expect_folded<long>(giprod, factor, product);
  expect_folded<long>(gihigh, value, high);
  expect_folded<long>(gilow, value, low);
}

// All 64 bits, of positive and negative numbers.
long word(long node, long i) {
  return static_cast<long>(static_cast<unsigned long>(node + 1) * 0x9e3779b97f4a7c15 >> (i % kPeriod));
}

void reduce_bits() {
  expect_folded<long>(giand, word, [](long a, long b) { return a & b; });
  expect_folded<long>(gior, word, [](long a, long b) { return a | b; });
  expect_folded<long>(gixor, word, [](long a, long b) { return a ^ b; });
}

RULE(reductions_of_doubles, "gdsum, gdprod, gdhigh and gdlow", "no element, and no node, is left out") {
  reduce_doubles();
}
RULE(reductions_of_floats, "gssum, gsprod, gshigh and gslow", "no element, and no node, is left out") {
  reduce_floats();
}
RULE(reductions_of_longs, "gisum, giprod, gihigh and gilow", "no element, and no node, is left out") { reduce_longs(); }
RULE(bits, "giand, gior and gixor work bit by bit, negative numbers too", "bits of different places do not mix") {
  reduce_bits();
}

// As if every value had been made 0 or 1 first: on one node alone, too.
template <long (*fold)(long, long)>
void expect_truth(void (*call)(long*, long, long*)) {
  if (is_host()) return;
  for (const long all : {0L, 1L, 2L}) {  // no node true, every node true, one of them true
    const auto of = [all](long node) { return all == 1 || (all == 2 && node == 0) ? 5 + node : 0; };
    long x = of(mynode()), work = 0, wanted = of(0) != 0;
    for (long node = 1; node < numnodes(); ++node) wanted = fold(wanted, of(node) != 0);
    call(&x, 1, &work);
    expect_equal(x, wanted);
  }
}

long both(long a, long b) { return a & b; }
long either(long a, long b) { return a | b; }
long one(long a, long b) { return a ^ b; }

void reduce_truths() {
  expect_truth<both>(gland);
  expect_truth<either>(glor);
  expect_truth<one>(glxor);
}

RULE(truths, "gland, glor and glxor take what is not 0 for true and give 0 or 1",
     "never another number, not even on a single node") {
  reduce_truths();
}

RULE(reductions_by_the_network, "all of them give the same results if MARS_NX_COLLECTIVES=mpi makes the network reduce",
     "none becomes another operation of the network") {
  messages::process().set_collectives(messages::CollectiveMethod::network);
  reduce_doubles();
  reduce_floats();
  reduce_longs();
  reduce_bits();
  reduce_truths();
  messages::process().set_collectives(messages::CollectiveMethod::automatic);
}

struct Peak {
  double height;
  long node;
};

long higher_peak(void* x, void* work) {
  auto* mine = static_cast<Peak*>(x);
  const auto* other = static_cast<Peak*>(work);
  const bool theirs = other->height > mine->height || (other->height == mine->height && other->node < mine->node);
  if (theirs) *mine = *other;
  return 0;
}

RULE(gopf_of_a_struct, "gopf combines with an operation of the program, and every node gets the result",
     "ties do not depend on the node") {
  if (is_host()) return;
  Peak x{static_cast<double>(mynode() * 5 % 3), mynode()}, work{};
  gopf(&x, sizeof x, &work, higher_peak);
  Peak wanted{-1, 0};
  for (long node = 0; node < numnodes(); ++node) {
    const double height = static_cast<double>(node * 5 % 3);
    if (height > wanted.height) wanted = {height, node};
  }
  expect_equal(x.height, wanted.height);
  expect_equal(x.node, wanted.node);
}

RULE(wrong_arguments_of_reductions, "an argument that is wrong on all nodes fails the call and its twin on all nodes",
     "EQLEN, EQPBUF; later calls work") {
  if (is_host()) return;
  double x = 0, work = 0;
  long whole = 0, whole_work = 0, count = 0;
  REFUSED(EQLEN, gdsum, (&x, -1, &work), "length -1");
  REFUSED(EQPBUF, gdhigh, (nullptr, 1, &work), "null");
  REFUSED(EQPBUF, gisum, (&whole, 1, nullptr), "null");
  REFUSED(EQLEN, gland, (&whole, -2, &whole_work), "length -2");
  REFUSED(EQPBUF, gopf, (&x, sizeof x, &work, nullptr), "null");
  REFUSED(EQLEN, gcol, (&x, -1, &x, 8, &count), "length -1");
  REFUSED(EQPBUF, gcol, (&x, 8, &x, 8, nullptr), "null");
  REFUSED(EQPBUF, gcolx, (&x, nullptr, &x), "null");
  gsync();
}

RULE(gsendx_to_a_list, "gsendx sends to each node of a list; these nodes receive by crecv",
     "nodes that are not in the list get nothing") {
  if (is_host()) return;
  std::vector<long> odd;
  for (long node = 1; node < numnodes(); node += 2) odd.push_back(node);
  if (mynode() == 0) {
    const long value = 77;
    gsendx(73, &value, sizeof value, odd.data(), static_cast<long>(odd.size()));
  }
  if (mynode() % 2 == 1) expect_equal(receive_long(73), 77);
  gsync();
  expect_equal(iprobe(73), 0);
}

RULE(wrong_arguments_of_gsendx, "gsendx checks its whole list before it sends",
     "EQNODE, EQTYPE, EQLEN, EQPBUF, and nothing has been sent") {
  long x = 0;
  const long list[2] = {mynode(), numnodes() + 1};
  REFUSED(EQNODE, gsendx, (73, &x, 8, list, 2), "no node");
  REFUSED(EQTYPE, gsendx, (-1, &x, 8, list, 1), "type -1");
  REFUSED(EQLEN, gsendx, (73, &x, -8, list, 1), "length -8");
  REFUSED(EQLEN, gsendx, (73, &x, 8, list, -1), "length -1");
  REFUSED(EQPBUF, gsendx, (73, &x, 8, nullptr, 1), "null");
  expect_equal(iprobe(73), 0);
}

}  // namespace
}  // namespace mars::conformance
