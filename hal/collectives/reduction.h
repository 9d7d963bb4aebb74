// Element-wise operations on vectors of all nodes of a group, the result on each of them with the same bits.
// The order, which matters to floating point: first positions p and p + 2^d where there is one, then pairs
// across bit 0, 1, ... d - 1 of the positions, always the lower position's operand on the left. It is the
// same for all ways that reduce knows.
#pragma once

#include <algorithm>
#include <cstddef>

#include "hal/collectives/dimension_exchange.h"
#include "hal/messages/backend.h"

namespace mars::collectives {

// An operation on `n` elements: x = x op theirs, or theirs op x where mine is not first; `theirs` may be
// changed.
struct Operation {
  std::size_t element;  // bytes
  void (*merge)(const Operation& operation, void* x, void* theirs, std::size_t n, bool mine_first);
  long (*own)(void* x, void* theirs) = nullptr;  // of gopf
};

template <class T, auto combine>
void merge(const Operation&, void* x, void* theirs, std::size_t n, bool mine_first) {
  T* mine = static_cast<T*>(x);
  const T* other = static_cast<const T*>(theirs);
  if (mine_first)
    std::transform(mine, mine + n, other, mine, combine);
  else
    std::transform(other, other + n, mine, mine, combine);
}

template <class T, auto combine>
constexpr Operation operation{sizeof(T), merge<T, combine>};

inline constexpr auto higher = [](auto a, auto b) { return a < b ? b : a; };

// By the network's own means if the process's collectives are to be so, the backend has them and all nodes
// take part; false: nothing was done. The order is then the network's.
bool reduce_by_network(const DimensionExchange& exchange, const messages::Reduction& reduction, void* x, std::size_t n);

// `x` and `work` have `n` elements; all members call, with the same n.
void reduce(DimensionExchange& exchange, const Operation& operation, void* x, std::size_t n, void* work);

}  // namespace mars::collectives
