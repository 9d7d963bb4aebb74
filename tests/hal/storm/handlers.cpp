#include "tests/hal/storm/handlers.h"

#include <array>
#include <utility>

#include "tests/hal/storm/rank.h"

namespace mars::storm {
namespace {

std::array<Rank*, 128> ranks;  // each rank, which may be a thread, its own

Came came(long type, long len, long node) {
  return {static_cast<int>(node), static_cast<std::int32_t>(type), static_cast<std::size_t>(len)};
}

template <int number>
void on_receive(long type, long len, long node, long) {
  ranks[static_cast<std::size_t>(mynode())]->received(number, came(type, len, node));
}

template <int number>
void on_send(long type, long len, long node, long) {
  ranks[static_cast<std::size_t>(mynode())]->sent(number, came(type, len, node));
}

template <int... number>
constexpr std::array<nx_handler, kHandlers> receive_handlers(std::integer_sequence<int, number...>) {
  return {on_receive<number>...};
}

template <int... number>
constexpr std::array<nx_handler, kHandlers> send_handlers(std::integer_sequence<int, number...>) {
  return {on_send<number>...};
}

constexpr long kHere = 999'000'001;
constexpr long kGo = 999'000'002;

}  // namespace

void handle_for(int id, Rank* rank) { ranks.at(static_cast<std::size_t>(id)) = rank; }

nx_handler receive_handler(int number) {
  static constexpr auto all = receive_handlers(std::make_integer_sequence<int, kHandlers>());
  return all[static_cast<std::size_t>(number)];
}

nx_handler send_handler(int number) {
  static constexpr auto all = send_handlers(std::make_integer_sequence<int, kHandlers>());
  return all[static_cast<std::size_t>(number)];
}

void meet() {
  if (mynode() == myhost()) {
    for (long node = 0; node < numnodes(); ++node) crecv(kHere, nullptr, 0);
    csend(kGo, nullptr, 0, -1, 0);
  } else {
    csend(kHere, nullptr, 0, myhost(), 0);
    crecv(kGo, nullptr, 0);
  }
}

}  // namespace mars::storm
