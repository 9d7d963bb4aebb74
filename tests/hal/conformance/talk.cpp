#include "tests/hal/conformance/talk.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <thread>

#include "hal/nx/nx_messages.h"

namespace mars::conformance {
namespace {

constexpr long kHasCome = 999'000'001;
constexpr long kGo = 999'000'002;

void gather() {
  for (long node = 0; node < numnodes(); ++node) receive_empty(kHasCome);
}

}  // namespace

bool is_host() { return mynode() == myhost(); }
long next_node() { return (mynode() + 1) % numnodes(); }
long previous_node() { return (mynode() + numnodes() - 1) % numnodes(); }

Bytes pattern(std::size_t size, std::uint32_t seed) {
  Bytes bytes(size);
  std::uint32_t word = seed * 2654435761u + 1;
  for (std::size_t at = 0; at < size; at += sizeof word) {
    word = word * 1664525u + 1013904223u;
    const std::uint32_t mixed = word ^ word >> 15;
    std::memcpy(bytes.data() + at, &mixed, std::min(sizeof mixed, size - at));
  }
  return bytes;
}

long length_of(const Bytes& bytes) { return static_cast<long>(bytes.size()); }

void send_long(long type, long value, long to) { csend(type, &value, sizeof value, to, 0); }

long receive_long(long typesel) {
  long value = -1;
  crecv(typesel, &value, sizeof value);
  return value;
}

void send_empty(long type, long to) { csend(type, nullptr, 0, to, 0); }
void receive_empty(long typesel) { crecv(typesel, nullptr, 0); }

void let_pass(double seconds) {
  const double end = dclock() + seconds;
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  while (dclock() < end) flick();
}

void meet(const std::function<void()>& between) {
  if (is_host()) {
    gather();
    between();
    send_empty(kGo, -1);
    gather();
    send_empty(kGo, -1);
    return;
  }
  send_empty(kHasCome, myhost());
  receive_empty(kGo);
  between();  // the host knows that all are here, and no node is further
  send_empty(kHasCome, myhost());
  receive_empty(kGo);
}

}  // namespace mars::conformance
