#include "host/render/farm/film_loading.h"

#include <algorithm>
#include <cstring>
#include <vector>

#include "hal/nx/nx_messages.h"
#include "host/render/farm/tracing.h"
#include "node/wire/greeting.h"

namespace mars::farm {
namespace {

void send_load(const wire::Load& load, std::span<const wire::Hello> hellos, std::span<const std::byte> orders) {
  std::vector<std::byte> message(sizeof load + hellos.size() * sizeof hellos[0].machine);
  std::memcpy(message.data(), &load, sizeof load);
  std::byte* to = message.data() + sizeof load;
  for (const wire::Hello& hello : hellos) {
    std::memcpy(to, &hello.machine, sizeof hello.machine);
    to += sizeof hello.machine;
  }
  message.insert(message.end(), orders.begin(), orders.end());
  for (const wire::Hello& hello : hellos)
    csend(wire::kLoad, message.data(), static_cast<long>(message.size()), hello.node, 0);
}

// To the first node, which leads its machine. The messages' ids.
std::vector<long> send_block(std::span<const std::byte> block) {
  std::vector<long> sends;
  for (std::size_t at = 0; at < block.size(); at += wire::kFilmPiece) {
    const auto piece = block.subspan(at, std::min<std::size_t>(block.size() - at, wire::kFilmPiece));
    sends.push_back(isend(wire::kFilmBlock, piece.data(), static_cast<long>(piece.size()), 0, 0));
  }
  return sends;
}

}  // namespace

bool load_film(std::span<const std::byte> block, wire::Load load, NodeInbox& inbox, std::span<const std::byte> orders) {
  const ScopedSpan span(trace::HostSpan::load, block.size());
  load.stamp = wire::own_stamp();
  load.film_bytes = block.size();
  load.orders = orders.size();
  inbox.expect_loaded();
  send_load(load, inbox.hellos(), orders);
  const std::vector<long> sends = send_block(block);
  const bool loaded = inbox.wait_until_loaded();
  for (const long send : sends) msgwait(send);
  return loaded;
}

}  // namespace mars::farm
