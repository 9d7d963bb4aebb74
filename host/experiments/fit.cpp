#include "host/experiments/fit.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

namespace mars::experiments {
namespace {

using Costs = std::vector<double>;

// Minimises |A x - b|^2 for x >= 0, given A'A and A'b, one unknown after the other.
class Squares {
 public:
  explicit Squares(std::size_t unknowns) : products_(unknowns, Costs(unknowns)), right_(unknowns) {}

  void add(const Measurement& measured, double soft) {
    const double scale = 1 / (measured.seconds + soft);
    for (std::size_t i = 0; i < right_.size(); ++i) {
      right_[i] += measured.units[i] * scale * measured.seconds * scale;
      for (std::size_t j = 0; j < right_.size(); ++j)
        products_[i][j] += measured.units[i] * scale * measured.units[j] * scale;
    }
  }

  Costs solve() const {
    constexpr int kSweeps = 20000;
    constexpr double kStill = 1e-9;  // change of a predicted time, relative
    Costs x(right_.size());
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      double change = 0;
      for (std::size_t i = 0; i < x.size(); ++i) change = std::max(change, improve(x, i));
      if (change < kStill) break;
    }
    return x;
  }

  // With each kind's units scaled to length 1, what others leave of one is 1 over its place in the inverse of A'A.
  std::vector<double> explained() const {
    std::vector<Costs> alike = products_;
    for (std::size_t i = 0; i < alike.size(); ++i)
      for (std::size_t j = 0; j < alike.size(); ++j) {
        const double length = std::sqrt(products_[i][i] * products_[j][j]);
        alike[i][j] = (length > 0 ? alike[i][j] / length : 0) + (i == j ? kRidge : 0);
      }
    invert(alike);
    std::vector<double> parts;
    for (std::size_t i = 0; i < alike.size(); ++i)
      parts.push_back(products_[i][i] > 0 ? std::clamp(1 - 1 / alike[i][i], 0.0, 1.0) : 1);
    return parts;
  }

 private:
  static constexpr double kRidge = 1e-9;  // of kinds that are always counted together

  // Of positive definite matrices, in place.
  static void invert(std::vector<Costs>& a) {
    for (std::size_t k = 0; k < a.size(); ++k) {
      const double pivot = std::exchange(a[k][k], 1);
      for (double& each : a[k]) each /= pivot;
      for (std::size_t i = 0; i < a.size(); ++i) {
        if (i == k) continue;
        const double factor = std::exchange(a[i][k], 0);
        for (std::size_t j = 0; j < a.size(); ++j) a[i][j] -= factor * a[k][j];
      }
    }
  }

  double improve(Costs& x, std::size_t i) const {
    const double weight = products_[i][i];
    if (weight == 0) return 0;
    const double predicted = std::inner_product(x.begin(), x.end(), products_[i].begin(), 0.0);
    const double before = x[i];
    x[i] = std::max(0.0, before + (right_[i] - predicted) / weight);
    return std::abs(x[i] - before) * std::sqrt(weight);
  }

  std::vector<Costs> products_;
  Costs right_;
};

std::vector<double> errors_of(std::span<const Measurement> measurements, const Costs& costs, double soft) {
  std::vector<double> errors;
  for (const Measurement& m : measurements) {
    const double predicted = std::inner_product(costs.begin(), costs.end(), m.units.begin(), 0.0);
    errors.push_back(std::abs(predicted - m.seconds) / (m.seconds + soft));
  }
  return errors;
}

double quantile(std::vector<double> values, double part) {
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1))];
}

Costs solve(std::span<const Measurement> measurements, std::span<const double> errors, double limit, double soft) {
  Squares squares(measurements.front().units.size());
  for (std::size_t i = 0; i < measurements.size(); ++i)
    if (errors[i] <= limit) squares.add(measurements[i], soft);
  return squares.solve();
}

}  // namespace

Fit fit_costs(std::span<const Measurement> measurements, double soft) {
  constexpr int kRounds = 3;
  constexpr double kFar = 5, kNear = 0.05;  // times the median error, and at least so much, is left out
  if (measurements.empty()) return {};
  std::vector<double> errors(measurements.size());
  Fit fit{solve(measurements, errors, 0, soft)};
  for (int round = 0; round < kRounds; ++round) {
    errors = errors_of(measurements, fit.costs, soft);
    fit.costs = solve(measurements, errors, kFar * std::max(kNear, quantile(errors, 0.5)), soft);
  }
  errors = errors_of(measurements, fit.costs, soft);
  fit.median_error = quantile(errors, 0.5);
  fit.high_error = quantile(errors, 0.9);
  return fit;
}

std::vector<double> explained_by_others(std::span<const Measurement> measurements, double soft) {
  if (measurements.empty()) return {};
  Squares squares(measurements.front().units.size());
  for (const Measurement& measured : measurements) squares.add(measured, soft);
  return squares.explained();
}

}  // namespace mars::experiments
