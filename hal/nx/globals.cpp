// The global operations and their twins.
#include "hal/nx/nx_global.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>

#include "hal/collectives/gathering.h"
#include "hal/collectives/reduction.h"
#include "hal/messages/arguments.h"
#include "hal/messages/process.h"
#include "hal/nx/guard.h"

namespace mars::nx {
namespace {

// Whole numbers wrap around.
using Bits = unsigned long;

constexpr auto product = [](auto a, auto b) { return a * b; };
constexpr auto lower = [](auto a, auto b) { return b < a ? b : a; };

collectives::Group all_nodes() { return {0, messages::process().backend().nodes()}; }

// A wrong argument spoils the exchange, so that the other nodes are not left waiting; the count is then 0.
std::size_t checked_count(collectives::DimensionExchange& exchange, const void* x, const void* work, long n) {
  if (n < 0) exchange.spoil(EQLEN, "length " + std::to_string(n) + " is negative", "give the number of elements");
  if (n > 0 && x == nullptr) exchange.spoil(EQPBUF, "the vector is a null pointer", "give a vector, or length 0");
  if (n > 0 && work == nullptr) exchange.spoil(EQPBUF, "work is a null pointer", "give one as long as the vector");
  return exchange.spoilt() ? 0 : static_cast<std::size_t>(n);
}

template <class T>
constexpr messages::Reduction::Element element_of = std::is_same_v<T, double>  ? messages::Reduction::Element::real64
                                                    : std::is_same_v<T, float> ? messages::Reduction::Element::real32
                                                                               : messages::Reduction::Element::whole;

template <class T>
void reduce_all(const char* call, const collectives::Operation& operation, messages::Reduction::Rule rule, T* x, long n,
                T* work) {
  collectives::DimensionExchange exchange(call, all_nodes());
  const std::size_t count = checked_count(exchange, x, work, n);
  if (!collectives::reduce_by_network(exchange, {element_of<T>, rule}, x, count))
    collectives::reduce(exchange, operation, x, count, work);
  exchange.conclude();
}

// Of 0 and 1, truth is a matter of bits.
template <auto combine>
void reduce_truths(const char* call, messages::Reduction::Rule rule, long* x, long n, long* work) {
  for (long i = 0; x != nullptr && i < n; ++i) x[i] = x[i] != 0;
  reduce_all(call, collectives::operation<long, combine>, rule, x, n, work);
}

void synchronize() {
  collectives::DimensionExchange exchange("gsync", all_nodes());
  collectives::reduce(exchange, collectives::operation<long, collectives::higher>, nullptr, 0, nullptr);
  exchange.conclude();
}

// The operand of the lower position is `x` on both sides, so that both get the same bits.
void merge_by_own(const collectives::Operation& operation, void* x, void* theirs, std::size_t, bool mine_first) {
  if (!mine_first) {
    auto* mine = static_cast<std::byte*>(x);
    std::swap_ranges(mine, mine + operation.element, static_cast<std::byte*>(theirs));
  }
  operation.own(x, theirs);
}

void operate_all(void* x, long xlen, void* work, nx_operation fn) {
  collectives::DimensionExchange exchange("gopf", all_nodes());
  const std::size_t bytes = checked_count(exchange, x, work, xlen);
  if (fn == nullptr) exchange.spoil(EQPBUF, "the operation is a null pointer", "give a function");
  collectives::reduce(exchange, {bytes, merge_by_own, fn}, x, 1, work);
  exchange.conclude();
}

// Used again by each call, so that steady use allocates nothing.
struct Scratch {
  struct Part {
    long length;    // of what the node gives
    long capacity;  // for what it gets
  };
  std::vector<Part> parts;
  std::vector<std::size_t> offsets;
};
thread_local Scratch scratch;

void check_buffer(collectives::DimensionExchange& exchange, const void* buffer, long length) {
  if (length < 0) exchange.spoil(EQLEN, "length " + std::to_string(length) + " is negative", "give a length in bytes");
  if (length > 0 && buffer == nullptr)
    exchange.spoil(EQPBUF,
                   "the buffer of " + messages::bytes_text(static_cast<std::size_t>(length)) + " is a null pointer",
                   "give a buffer, or length 0");
}

// offsets[i] = bytes before node i's part, offsets[nodes] = all, from each node's length; none where spoilt.
template <class LengthOf>
const std::vector<std::size_t>& add_up(const collectives::DimensionExchange& exchange, LengthOf length_of) {
  std::vector<std::size_t>& offsets = scratch.offsets;
  offsets.assign(static_cast<std::size_t>(exchange.count()) + 1, 0);
  for (std::size_t i = 0; i + 1 < offsets.size() && !exchange.spoilt(); ++i)
    offsets[i + 1] = offsets[i] + static_cast<std::size_t>(length_of(i));
  return offsets;
}

void concatenate(collectives::DimensionExchange& exchange, const void* x, const std::vector<std::size_t>& offsets,
                 void* y) {
  const auto me = static_cast<std::size_t>(exchange.position());
  const std::size_t size = offsets[me + 1] - offsets[me];
  if (size > 0) std::memmove(static_cast<std::byte*>(y) + offsets[me], x, size);
  collectives::gather(exchange, y, offsets);
  exchange.conclude();
}

void concatenate_known(const void* x, const long* xlens, void* y) {
  collectives::DimensionExchange exchange("gcolx", all_nodes());
  if (xlens == nullptr) exchange.spoil(EQPBUF, "the lengths are a null pointer", "give the length of each node's part");
  long all = 0;
  for (int i = 0; i < exchange.count() && !exchange.spoilt(); all += xlens[i++]) check_buffer(exchange, y, xlens[i]);
  if (!exchange.spoilt()) check_buffer(exchange, x, xlens[exchange.position()]);
  const auto& offsets = add_up(exchange, [xlens](std::size_t i) { return xlens[i]; });
  concatenate(exchange, x, offsets, y);
}

// All nodes know all lengths and capacities before they go on, and so fail together.
void concatenate_all(const void* x, long xlen, void* y, long ylen, long* ncnt) {
  collectives::DimensionExchange exchange("gcol", all_nodes());
  check_buffer(exchange, x, xlen);
  check_buffer(exchange, y, ylen);
  if (ncnt == nullptr) exchange.spoil(EQPBUF, "ncnt is a null pointer", "give a place for the number of bytes");
  std::vector<Scratch::Part>& parts = scratch.parts;
  parts.resize(static_cast<std::size_t>(exchange.count()));
  parts[static_cast<std::size_t>(exchange.position())] = {xlen, ylen};
  std::vector<std::size_t>& places = scratch.offsets;
  places.resize(parts.size() + 1);
  for (std::size_t i = 0; i < places.size(); ++i) places[i] = i * sizeof(Scratch::Part);
  collectives::gather(exchange, parts.data(), places);
  exchange.conclude();
  const auto& offsets = add_up(exchange, [&parts](std::size_t i) { return parts[i].length; });
  const long all = static_cast<long>(offsets.back());
  for (std::size_t node = 0; node < parts.size(); ++node) {
    if (all <= parts[node].capacity) continue;
    messages::process().fail("gcol", EQMSGLONG,
                             "the " + std::to_string(all) + " bytes of all nodes do not fit the " +
                                 std::to_string(parts[node].capacity) + " that node " + std::to_string(node) +
                                 " can take",
                             "give a buffer for the bytes of all nodes");
  }
  concatenate(exchange, x, offsets, y);
  *ncnt = all;
}

void send_to_list(long type, const void* x, long xlen, const long* nodes, long n) {
  if (n < 0)
    messages::process().fail("gsendx", EQLEN, "length " + std::to_string(n) + " is negative",
                             "give the number of nodes");
  if (n > 0 && nodes == nullptr)
    messages::process().fail("gsendx", EQPBUF, "the nodes are a null pointer", "give a list of nodes");
  const auto check = [&](long node) { messages::check_send(messages::process(), "gsendx", type, x, xlen, node, 0); };
  for (long i = 0; i < n; ++i) {
    check(nodes[i]);
    if (nodes[i] < 0)
      messages::process().fail("gsendx", EQNODE, "there is no node " + std::to_string(nodes[i]), "name each node");
  }
  for (long i = 0; i < n; ++i) messages::process().csend(type, x, xlen, nodes[i], 0);
}

}  // namespace
}  // namespace mars::nx

using namespace mars::nx;

// A call and its twin.
#define VECTOR_CALL(name, T, call)        \
  void name(T x[], long n, T work[]) {    \
    plain([&] { call; });                 \
  }                                       \
  long _##name(T x[], long n, T work[]) { \
    return twin([&] { call; });           \
  }
#define REDUCTION(name, T, As, combine, rule)                                                                         \
  VECTOR_CALL(name, T,                                                                                                \
              (reduce_all(#name, mars::collectives::operation<As, combine>, mars::messages::Reduction::Rule::rule, x, \
                          n, work)))
#define TRUTHS(name, combine, rule) \
  VECTOR_CALL(name, long, (reduce_truths<combine>(#name, mars::messages::Reduction::Rule::rule, x, n, work)))

extern "C" {

REDUCTION(gdsum, double, double, std::plus<double>{}, sum)
REDUCTION(gdprod, double, double, product, product)
REDUCTION(gdhigh, double, double, mars::collectives::higher, high)
REDUCTION(gdlow, double, double, lower, low)
REDUCTION(gssum, float, float, std::plus<float>{}, sum)
REDUCTION(gsprod, float, float, product, product)
REDUCTION(gshigh, float, float, mars::collectives::higher, high)
REDUCTION(gslow, float, float, lower, low)
REDUCTION(gisum, long, Bits, std::plus<Bits>{}, sum)
REDUCTION(giprod, long, Bits, product, product)
REDUCTION(gihigh, long, long, mars::collectives::higher, high)
REDUCTION(gilow, long, long, lower, low)
REDUCTION(giand, long, Bits, std::bit_and<Bits>{}, bit_and)
REDUCTION(gior, long, Bits, std::bit_or<Bits>{}, bit_or)
REDUCTION(gixor, long, Bits, std::bit_xor<Bits>{}, bit_xor)
TRUTHS(gland, std::bit_and<long>{}, bit_and)
TRUTHS(glor, std::bit_or<long>{}, bit_or)
TRUTHS(glxor, std::bit_xor<long>{}, bit_xor)

void gsync(void) { plain(synchronize); }
long _gsync(void) { return twin(synchronize); }

void gopf(void* x, long xlen, void* work, nx_operation fn) {
  plain([&] { operate_all(x, xlen, work, fn); });
}
long _gopf(void* x, long xlen, void* work, nx_operation fn) {
  return twin([&] { operate_all(x, xlen, work, fn); });
}

void gcol(const void* x, long xlen, void* y, long ylen, long* ncnt) {
  plain([&] { concatenate_all(x, xlen, y, ylen, ncnt); });
}
long _gcol(const void* x, long xlen, void* y, long ylen, long* ncnt) {
  return twin([&] { concatenate_all(x, xlen, y, ylen, ncnt); });
}

void gcolx(const void* x, const long xlens[], void* y) {
  plain([&] { concatenate_known(x, xlens, y); });
}
long _gcolx(const void* x, const long xlens[], void* y) {
  return twin([&] { concatenate_known(x, xlens, y); });
}

void gsendx(long type, const void* x, long xlen, const long nodes[], long n) {
  plain([&] { send_to_list(type, x, xlen, nodes, n); });
}
long _gsendx(long type, const void* x, long xlen, const long nodes[], long n) {
  return twin([&] { send_to_list(type, x, xlen, nodes, n); });
}

}  // extern "C"
