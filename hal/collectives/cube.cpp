#include "hal/collectives/cube.h"

#include <functional>

#include "hal/failure/failure.h"
#include "hal/collectives/reduction.h"

namespace mars::hal {
namespace {

void reduce_in(const char* call, const Cube& cube, const Operation& operation, std::span<double> values,
               std::span<double> work) {
  check(work.size() >= values.size(), "work is as long as the values");
  DimensionExchange exchange(call, cube);
  reduce(exchange, operation, values.data(), values.size(), work.data());
  exchange.conclude();
}

}  // namespace

void cube_sum(const Cube& cube, std::span<double> values, std::span<double> work) {
  reduce_in("cube_sum", cube, operation<double, std::plus<double>{}>, values, work);
}

void cube_high(const Cube& cube, std::span<double> values, std::span<double> work) {
  reduce_in("cube_high", cube, operation<double, higher>, values, work);
}

}  // namespace mars::hal
