#include "hal/collectives/group_sum.h"

#include <functional>

#include "hal/collectives/reduction.h"
#include "hal/failure/failure.h"

namespace mars::collectives {
namespace {

void reduce_in(const char* call, const Group& group, const Operation& operation, std::span<std::uint64_t> values,
               std::span<std::uint64_t> work) {
  check(work.size() >= values.size(), "work is as long as the values");
  DimensionExchange exchange(call, group);
  reduce(exchange, operation, values.data(), values.size(), work.data());
  exchange.conclude();
}

}  // namespace

void group_sum(const Group& group, std::span<std::uint64_t> values, std::span<std::uint64_t> work) {
  reduce_in("group_sum", group, operation<std::uint64_t, std::plus<std::uint64_t>{}>, values, work);
}

void group_high(const Group& group, std::span<std::uint64_t> values, std::span<std::uint64_t> work) {
  reduce_in("group_high", group, operation<std::uint64_t, higher>, values, work);
}

}  // namespace mars::collectives
