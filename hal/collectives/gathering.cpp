#include "hal/collectives/gathering.h"

#include <algorithm>

namespace mars::collectives {
namespace {

// The parts of a run of positions.
struct Run {
  std::byte* data;
  std::size_t bytes;
};

}  // namespace

// At each step a node has the parts of an aligned run of corners, and of those folded into them: two ranges of
// y. Runs beyond the last position are not sent.
void gather(DimensionExchange& exchange, void* y, const std::vector<std::size_t>& offsets) {
  const int me = exchange.position();
  const int corners = exchange.corners();
  const auto run = [&](int first, int last) {
    const int from = std::min(first, exchange.count()), to = std::min(last, exchange.count());
    return Run{static_cast<std::byte*>(y) + offsets[static_cast<std::size_t>(from)],
               offsets[static_cast<std::size_t>(to)] - offsets[static_cast<std::size_t>(from)]};
  };
  if (exchange.folded()) {
    const Run mine = run(me, me + 1), all = run(0, exchange.count());
    exchange.send(me - corners, mine.data, mine.bytes);
    exchange.receive(me - corners, all.data, all.bytes);
    return;
  }
  if (exchange.folds()) {
    const Run folded = run(me + corners, me + corners + 1);
    exchange.receive(me + corners, folded.data, folded.bytes);
  }
  for (int bit = 1; bit < corners; bit <<= 1) {
    const int mine = me & ~(bit - 1), theirs = mine ^ bit;
    const auto swap = [&](int shift) {
      const Run out = run(mine + shift, mine + shift + bit), in = run(theirs + shift, theirs + shift + bit);
      exchange.swap_with(me ^ bit, out.data, out.bytes, in.data, in.bytes);
    };
    swap(0);
    if (corners + std::min(mine, theirs) < exchange.count()) swap(corners);
  }
  if (exchange.folds()) {
    const Run all = run(0, exchange.count());
    exchange.send(me + corners, all.data, all.bytes);
  }
}

}  // namespace mars::collectives
