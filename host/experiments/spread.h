// How far forecasts are off: what renderings took over what was forecast of them, as a calibration found by trials. It
// holds the errors of the costs and what differs from one rendering to the next, of a noisy calibration more.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace mars::experiments {

// Of trials on a number of nodes. Another rendering's ratio lies from `low` to `high` with kWithin.
struct Spread {
  int nodes = 1;
  bool files = false;  // which were written; else frames went nowhere
  double low = 1;
  double middle = 1;  // half of the renderings took more
  double high = 1;

  bool operator==(const Spread&) const = default;
};

inline constexpr double kWithin = 0.9;

inline constexpr int kFewestTrials = 19;

// From trials' ratios, kFewestTrials at least. The bounds are two of them, whatever their distribution: of n ratios,
// one more lies below the k-th least with k / (n + 1).
Spread spread_of(int nodes, bool files, std::vector<double> ratios);

// What renderings took over what was forecast, in the middle: for any number of nodes that of the nearest known one; 1
// where nothing is known.
double middle_for(std::span<const Spread> known, int nodes, bool files);

// For any number of nodes between those of `known`; none where it lies beyond, or nothing is known.
std::optional<Spread> spread_for(std::span<const Spread> known, int nodes, bool files);

}  // namespace mars::experiments
