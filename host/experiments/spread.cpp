#include "host/experiments/spread.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "hal/failure/failure.h"

namespace mars::experiments {
namespace {

constexpr double kBeyond = (1 - kWithin) / 2;  // at either end

// Ratios are interpolated by their logarithms, and nodes too: a rendering on twice as many is one step.
double between(double low, double high, double part) { return std::pow(low, 1 - part) * std::pow(high, part); }

Spread between(const Spread& before, const Spread& after, int nodes) {
  if (before.nodes == after.nodes) return before;
  const double part =
      std::log(static_cast<double>(nodes) / before.nodes) / std::log(static_cast<double>(after.nodes) / before.nodes);
  return {nodes, before.files, between(before.low, after.low, part), between(before.middle, after.middle, part),
          between(before.high, after.high, part)};
}

}  // namespace

Spread spread_of(int nodes, bool files, std::vector<double> ratios) {
  const auto count = static_cast<double>(ratios.size());
  const auto beyond = static_cast<std::size_t>(std::floor(kBeyond * (count + 1) + 1e-9));
  check(beyond >= 1, "trials are too few for bounds");
  std::ranges::sort(ratios);
  return {nodes, files, ratios[beyond - 1], ratios[ratios.size() / 2], ratios[ratios.size() - beyond]};
}

std::optional<Spread> spread_for(std::span<const Spread> known, int nodes, bool files) {
  const Spread *before = nullptr, *after = nullptr;  // the nearest on either side
  for (const Spread& spread : known) {
    if (spread.files != files) continue;
    if (spread.nodes <= nodes && (before == nullptr || spread.nodes > before->nodes)) before = &spread;
    if (spread.nodes >= nodes && (after == nullptr || spread.nodes < after->nodes)) after = &spread;
  }
  if (before == nullptr || after == nullptr) return std::nullopt;
  return between(*before, *after, nodes);
}

double middle_for(std::span<const Spread> known, int nodes, bool files) {
  if (const auto spread = spread_for(known, nodes, files)) return spread->middle;
  const Spread* nearest = nullptr;
  for (const Spread& spread : known)
    if (spread.files == files &&
        (nearest == nullptr || std::abs(spread.nodes - nodes) < std::abs(nearest->nodes - nodes)))
      nearest = &spread;
  return nearest == nullptr ? 1 : nearest->middle;
}

}  // namespace mars::experiments
