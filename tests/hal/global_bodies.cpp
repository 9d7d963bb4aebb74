// Bodies of the global operations: every operation's exact answer, in the same bits everywhere; and what is wrong on
// one node is told on all.
#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <functional>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hal/call_failure.h"
#include "hal/crystal_router.h"
#include "hal/cube.h"
#include "hal/nx/nx_global.h"
#include "hal/nx/nx_messages.h"
#include "hal/process.h"
#include "tests/hal/nx_bodies.h"

namespace mars::hal {
namespace {

bool is_host() { return mynode() == myhost(); }

// Short ones go whole across each dimension, long ones in parts; odd lengths do not halve evenly.
const std::vector<long> kLengths = {0, 1, 3, 2160, 12'001};

// What node `node` gives as element `i`: small whole numbers, so that every order of operations is exact.
template <class T>
T given(long node, long i) {
  return static_cast<T>((node * 7 + i * 3) % 11 - 5);
}

template <class T>
using Call = void (*)(T x[], long n, T work[]);

// `call` on all nodes is `combine` of all nodes' elements one after another.
template <class T>
void expect_all(Call<T> call, const std::function<T(T, T)>& combine, T (*give)(long, long) = given<T>) {
  for (const long n : kLengths) {
    std::vector<T> x(static_cast<std::size_t>(n)), work(x.size());
    for (long i = 0; i < n; ++i) x[static_cast<std::size_t>(i)] = give(mynode(), i);
    call(x.data(), n, work.data());
    for (long i = 0; i < n; ++i) {
      T expected = give(0, i);
      for (long node = 1; node < numnodes(); ++node) expected = combine(expected, give(node, i));
      ASSERT_EQ(x[static_cast<std::size_t>(i)], expected) << "element " << i << " of " << n;
    }
  }
}

template <class T>
T one_or_two(long node, long i) {
  return static_cast<T>(1 + (node + i) % 2);
}

template <class T>
void expect_arithmetic(Call<T> sum, Call<T> product, Call<T> high, Call<T> low) {
  expect_all<T>(sum, [](T a, T b) { return a + b; });
  expect_all<T>(product, [](T a, T b) { return a * b; }, one_or_two<T>);
  expect_all<T>(high, [](T a, T b) { return std::max(a, b); });
  expect_all<T>(low, [](T a, T b) { return std::min(a, b); });
}

void doubles_of_all_nodes() {
  if (!is_host()) expect_arithmetic<double>(gdsum, gdprod, gdhigh, gdlow);
}
void floats_of_all_nodes() {
  if (!is_host()) expect_arithmetic<float>(gssum, gsprod, gshigh, gslow);
}
void whole_numbers_of_all_nodes() {
  if (!is_host()) expect_arithmetic<long>(gisum, giprod, gihigh, gilow);
}

void bits_of_all_nodes() {
  if (is_host()) return;
  const auto bits = [](long node, long i) { return static_cast<long>((node + 1) * 0x9e3779b97f4a7c15UL >> (i % 20)); };
  expect_all<long>(giand, [](long a, long b) { return a & b; }, bits);
  expect_all<long>(gior, [](long a, long b) { return a | b; }, bits);
  expect_all<long>(gixor, [](long a, long b) { return a ^ b; }, bits);
}

void truths_of_all_nodes() {
  if (is_host()) return;
  for (long i = 0; i < 8; ++i) {
    // Node k gives 5 where bit k % 3 of i is set: true, but not 1.
    const auto truth = [i](long node) { return i >> node % 3 & 1; };
    long all = 1, any = 0, odd = 0;
    for (long node = 0; node < numnodes(); ++node) {
      all = all && truth(node);
      any = any || truth(node);
      odd ^= truth(node);
    }
    long x[3] = {5 * truth(mynode()), 5 * truth(mynode()), 5 * truth(mynode())}, work = 0;
    gland(&x[0], 1, &work);
    glor(&x[1], 1, &work);
    glxor(&x[2], 1, &work);
    EXPECT_EQ(x[0], all);
    EXPECT_EQ(x[1], any);
    EXPECT_EQ(x[2], odd);
  }
}

double awkward(long node) { return 1.0 / (3 + static_cast<double>(node)) + 1e10 * static_cast<double>(node % 3); }

// The order that hal/cube.h promises, done by one.
double sum_in_order(long nodes, double scale) {
  std::vector<double> values;
  for (long node = 0; node < nodes; ++node) values.push_back(scale * awkward(node));
  const std::size_t corners = std::bit_floor(values.size());
  for (std::size_t i = corners; i < values.size(); ++i) values[i - corners] += values[i];
  for (std::size_t step = 1; step < corners; step <<= 1)
    for (std::size_t i = 0; i < corners; i += 2 * step) values[i] += values[i + step];
  return values[0];
}

// However long the vectors are.
void sums_have_one_order() {
  if (is_host()) return;
  for (const long n : {1L, 100L, 2160L, 20'003L}) {
    std::vector<double> x(static_cast<std::size_t>(n)), work(x.size());
    for (long i = 0; i < n; ++i) x[static_cast<std::size_t>(i)] = static_cast<double>(i % 17 + 1) * awkward(mynode());
    gdsum(x.data(), n, work.data());
    for (long i = 0; i < n; ++i)
      ASSERT_EQ(std::bit_cast<std::uint64_t>(x[static_cast<std::size_t>(i)]),
                std::bit_cast<std::uint64_t>(sum_in_order(numnodes(), static_cast<double>(i % 17 + 1))));
  }
}

// Composition of x -> a x + b is associative and not commutative: the lower operand is `x` on all nodes.
struct Map {
  std::int64_t a;
  std::int64_t b;
};
long compose(void* x, void* work) {
  Map& first = *static_cast<Map*>(x);
  const Map& then = *static_cast<Map*>(work);
  first = {first.a * then.a % 10007, (first.b * then.a + then.b) % 10007};
  return 0;
}

void an_operation_of_ones_own() {
  if (is_host()) return;
  const auto map_of = [](long node) { return Map{2 + node, 3 * node + 1}; };
  Map mine = map_of(mynode()), work{};
  gopf(&mine, sizeof mine, &work, compose);
  // As the exchange pairs them.
  std::vector<Map> maps;
  for (long node = 0; node < numnodes(); ++node) maps.push_back(map_of(node));
  const std::size_t corners = std::bit_floor(maps.size());
  for (std::size_t i = corners; i < maps.size(); ++i) compose(&maps[i - corners], &maps[i]);
  for (std::size_t step = 1; step < corners; step <<= 1)
    for (std::size_t i = 0; i < corners; i += 2 * step) compose(&maps[i], &maps[i + step]);
  EXPECT_EQ(mine.a, maps[0].a);
  EXPECT_EQ(mine.b, maps[0].b);
}

void parts_of_all_nodes() {
  if (is_host()) return;
  for (const long scale : {0L, 1L, 5000L}) {
    const auto length_of = [scale](long node) { return scale * (node * 5 % 7); };
    std::string all;
    std::vector<long> lengths;
    for (long node = 0; node < numnodes(); ++node) {
      lengths.push_back(length_of(node));
      all.append(static_cast<std::size_t>(lengths.back()), static_cast<char>('a' + node % 26));
    }
    const std::string mine(static_cast<std::size_t>(length_of(mynode())), static_cast<char>('a' + mynode() % 26));
    std::string y(all.size() + 3, '-'), z = y;
    long count = -1;
    gcol(mine.data(), static_cast<long>(mine.size()), y.data(), static_cast<long>(y.size()), &count);
    EXPECT_EQ(count, static_cast<long>(all.size()));
    EXPECT_EQ(y, all + "---");
    gcolx(mine.data(), lengths.data(), z.data());
    EXPECT_EQ(z, all + "---");
  }
}

void a_list_of_receivers() {
  constexpr long kType = 77;
  std::vector<long> odd;
  for (long node = 1; node < numnodes(); node += 2) odd.push_back(node);
  const long value = 4711;
  if (mynode() == 0) {
    gsendx(kType, &value, sizeof value, odd.data(), static_cast<long>(odd.size()));
    EXPECT_EQ(_gsendx(kType, &value, sizeof value, odd.data(), -1), -1);
    EXPECT_EQ(errno, EQLEN);
    EXPECT_EQ(_gsendx(kType, &value, sizeof value, nullptr, 1), -1);
    EXPECT_EQ(errno, EQPBUF);
    const long nobody = numnodes() + 1;
    EXPECT_EQ(_gsendx(kType, &value, sizeof value, &nobody, 1), -1);
    EXPECT_EQ(errno, EQNODE);
  } else if (!is_host() && mynode() % 2 == 1) {
    long got = 0;
    crecv(kType, &got, sizeof got);
    EXPECT_EQ(got, value);
  }
}

// errno of a twin that fails, and what it says has all of `parts`.
void expect_errno(int code, long result) {
  EXPECT_EQ(result, -1);
  EXPECT_EQ(result == -1 ? errno : 0, code);
}

void still_in_step() {
  long one = 1, work = 0;
  gisum(&one, 1, &work);
  EXPECT_EQ(one, numnodes());
}

void the_host_is_told() {
  if (!is_host()) return;
  double x = 0, work = 0;
  long count = 0;
  expect_errno(EQNODE, _gsync());
  expect_errno(EQNODE, _gdsum(&x, 1, &work));
  expect_errno(EQNODE, _gcol(&x, 8, &x, 8, &count));
}

// On every node whose arguments are wrong, and on all where one is.
void wrong_arguments_are_told_on_all() {
  if (is_host()) return;
  double x = 0, work = 0;
  long count = 0;
  expect_errno(EQLEN, _gdsum(&x, -1, &work));
  expect_errno(EQPBUF, _gdsum(nullptr, 1, &work));
  expect_errno(EQPBUF, _gdsum(&x, 1, nullptr));
  expect_errno(EQPBUF, _gopf(&x, 8, &work, nullptr));
  expect_errno(EQLEN, _gcol(&x, -1, &x, 8, &count));
  expect_errno(EQPBUF, _gcolx(&x, nullptr, &x));
  still_in_step();
  for (long wrong = 0; wrong < numnodes(); ++wrong) {
    const long result = _gdsum(&x, mynode() == wrong ? -1 : 1, &work);
    expect_errno(EQLEN, result);
  }
  still_in_step();
}

void different_lengths_are_told_on_all() {
  if (is_host() || numnodes() == 1) return;
  std::vector<double> x(20'000), work(x.size());
  for (const auto& [usual, odd] : {std::pair{1L, 2L}, {5L, 0L}, {20'000L, 1L}, {0L, 20'000L}, {8'100L, 8'300L}})
    for (long other = 0; other < numnodes(); ++other) {
      expect_errno(EQLEN, _gdsum(x.data(), mynode() == other ? odd : usual, work.data()));
      still_in_step();
    }
}

// Not all can see it.
void different_lists_of_lengths_are_told() {
  if (is_host() || numnodes() == 1) return;
  std::vector<char> x(16), y(static_cast<std::size_t>(16 * numnodes()));
  for (long other = 0; other < numnodes(); ++other) {
    std::vector<long> lengths(static_cast<std::size_t>(numnodes()), 8);
    if (mynode() == other) lengths[0] = 16;
    long told = _gcolx(x.data(), lengths.data(), y.data()) == -1, work = 0;
    if (told == 1) {
      EXPECT_EQ(errno, EQLEN);
    }
    gisum(&told, 1, &work);
    EXPECT_GE(told, 1);
  }
}

// Too little room on one node is a failure of all.
void room_for_all_parts() {
  if (is_host()) return;
  std::vector<char> mine(4), y(static_cast<std::size_t>(4 * numnodes()));
  long count = 0;
  for (long small = 0; small < numnodes(); ++small)
    expect_errno(EQMSGLONG, _gcol(mine.data(), 4, y.data(), 4 * numnodes() - (mynode() == small), &count));
  still_in_step();
}

// As a node's parcel to another one must be: some get several, some none.
std::string parcel_of(long from, long to, long number) {
  const long length = (from * 5 + to * 3 + number) % 7 == 0 ? 30'000 : (from + to + number) % 50;
  return std::string(static_cast<std::size_t>(length), static_cast<char>('a' + (from + 2 * to + number) % 26));
}
long parcels_between(long from, long to) { return (from * 3 + to) % 3; }

void parcels_go_by_every_route() {
  if (is_host()) return;
  CrystalRouter router;
  std::vector<std::string> texts;
  for (long to = 0; to < numnodes(); ++to)
    for (long number = 0; number < parcels_between(mynode(), to); ++number) texts.push_back(parcel_of(mynode(), to, number));
  std::vector<Parcel> parcels;
  for (long to = 0; to < numnodes(); ++to)
    for (long number = 0; number < parcels_between(mynode(), to); ++number)
      parcels.push_back({static_cast<int>(to), std::as_bytes(std::span(texts[parcels.size()]))});
  std::reverse(parcels.begin(), parcels.end());
  for (const Route route : {Route::automatic, Route::crystal, Route::direct, Route::network, Route::crystal}) {
    const std::span<const Parcel> got = router.exchange({0, static_cast<int>(numnodes())}, parcels, route);
    std::size_t next = 0;
    for (long from = 0; from < numnodes(); ++from)
      for (long number = parcels_between(from, mynode()); number-- > 0; ++next) {
        ASSERT_LT(next, got.size());
        EXPECT_EQ(got[next].node, from);
        const std::string text(reinterpret_cast<const char*>(got[next].bytes.data()), got[next].bytes.size());
        EXPECT_EQ(text, parcel_of(from, mynode(), number));
      }
    EXPECT_EQ(next, got.size());
  }
}

// Each half of the nodes among themselves.
void parcels_within_a_cube() {
  if (is_host() || numnodes() == 1) return;
  const auto nodes = static_cast<int>(numnodes());
  const Cube cube = cube_of(nodes, 2, mynode() < nodes / 2 ? 0 : 1);
  CrystalRouter router;
  for (const Route route : {Route::automatic, Route::crystal, Route::direct, Route::network}) {
    const int to = cube.first + (static_cast<int>(mynode()) - cube.first + 1) % cube.count;
    const std::string text = std::to_string(mynode());
    const std::vector<Parcel> parcels = {{to, std::as_bytes(std::span(text))}};
    const std::span<const Parcel> got = router.exchange(cube, parcels, route);
    ASSERT_EQ(got.size(), 1u);
    EXPECT_EQ(got[0].node, cube.first + (static_cast<int>(mynode()) - cube.first + cube.count - 1) % cube.count);
    EXPECT_EQ(got[0].bytes.size(), std::to_string(got[0].node).size());
  }
}

// Where the backend has its own; else across the cube.
void by_the_networks_own_means() {
  if (is_host()) return;
  process().collectives_by(Collectives::network);
  doubles_of_all_nodes();
  floats_of_all_nodes();
  whole_numbers_of_all_nodes();
  bits_of_all_nodes();
  truths_of_all_nodes();
  parcels_go_by_every_route();
  process().collectives_by(Collectives::automatic);
}

}  // namespace

std::vector<NxBody> global_bodies() {
#define BODY(function) \
  NxBody { #function, function }
  return {BODY(doubles_of_all_nodes),
          BODY(floats_of_all_nodes),
          BODY(whole_numbers_of_all_nodes),
          BODY(bits_of_all_nodes),
          BODY(truths_of_all_nodes),
          BODY(sums_have_one_order),
          BODY(an_operation_of_ones_own),
          BODY(parts_of_all_nodes),
          BODY(a_list_of_receivers),
          BODY(parcels_go_by_every_route),
          BODY(parcels_within_a_cube),
          BODY(by_the_networks_own_means),
          BODY(the_host_is_told),
          BODY(wrong_arguments_are_told_on_all),
          BODY(different_lengths_are_told_on_all),
          BODY(different_lists_of_lengths_are_told),
          BODY(room_for_all_parts)};
#undef BODY
}

}  // namespace mars::hal
