#include "node/film_receiver.h"

#include <algorithm>
#include <vector>

#include "hal/nx/nx_messages.h"
#include "node/group/pending_messages.h"
#include "node/wire/commands.h"
#include "node/wire/protocol.h"

namespace mars::node {
namespace {

constexpr std::size_t kMostOnTheWay = 256;  // pieces; message ids are limited

// The leader numbered k passes the film on to those numbered 2k + 1 and 2k + 2.
std::vector<int> receivers_from(int self, std::span<const std::int32_t> machines) {
  std::vector<int> leaders;
  for (std::size_t node = 0; node < machines.size(); ++node)
    if (machines[node] == static_cast<std::int32_t>(node)) leaders.push_back(static_cast<int>(node));
  const auto number = static_cast<std::size_t>(std::ranges::lower_bound(leaders, self) - leaders.begin());
  const std::size_t first = std::min(2 * number + 1, leaders.size()), last = std::min(first + 2, leaders.size());
  return {leaders.begin() + static_cast<std::ptrdiff_t>(first), leaders.begin() + static_cast<std::ptrdiff_t>(last)};
}

}  // namespace

void receive_film(std::span<std::byte> block, std::span<const std::int32_t> machines) {
  const std::vector<int> receivers = receivers_from(static_cast<int>(mynode()), machines);
  group::PendingMessages pending;
  for (std::size_t pieces = 1; !block.empty(); ++pieces) {
    const auto piece = block.first(std::min<std::size_t>(block.size(), wire::kFilmPiece));
    crecv(wire::kFilmBlock, piece.data(), static_cast<long>(piece.size()));
    wire::check_size("FilmBlock", static_cast<std::size_t>(infocount()), piece.size());
    for (const int to : receivers)
      pending.add(isend(wire::kFilmBlock, piece.data(), static_cast<long>(piece.size()), to, 0));
    if (pieces % kMostOnTheWay == 0) pending.wait();
    block = block.subspan(piece.size());
  }
  pending.wait();
}

}  // namespace mars::node
