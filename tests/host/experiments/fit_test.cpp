#include "host/experiments/fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace mars::experiments {
namespace {

constexpr double kSoft = 1e-6;

// Times that `costs` explain.
std::vector<Measurement> measurements(const std::vector<double>& costs, int count) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> exponent(1, 6);
  std::vector<Measurement> all;
  for (int i = 0; i < count; ++i) {
    Measurement measured{{}, 0};
    for (const double cost : costs) {
      measured.units.push_back(std::round(std::pow(10, exponent(random))));
      measured.seconds += cost * measured.units.back();
    }
    all.push_back(measured);
  }
  return all;
}

TEST(Fit, FindsTheCostsOfExactTimes) {
  const std::vector<double> costs{2e-7, 5e-9, 3e-8};
  const Fit fit = fit_costs(measurements(costs, 60), kSoft);
  for (std::size_t i = 0; i < costs.size(); ++i) EXPECT_NEAR(fit.costs[i] / costs[i], 1, 0.01) << i;
  EXPECT_LT(fit.high_error, 0.01);
}

TEST(Fit, GivesNothingANegativeCost) {
  std::vector<Measurement> all = measurements({1e-7, 1e-7}, 40);
  for (Measurement& m : all) m.seconds = std::max(1e-7 * m.units[0] - 2e-8 * m.units[1], 1e-7);
  const Fit fit = fit_costs(all, kSoft);
  EXPECT_GE(fit.costs[0], 0);
  EXPECT_GE(fit.costs[1], 0);
  EXPECT_LT(fit.costs[1], 1e-11);
}

TEST(Fit, LeavesOutTimesThatAreFarFromAll) {
  const std::vector<double> costs{1e-7, 4e-8};
  std::vector<Measurement> all = measurements(costs, 60);
  for (std::size_t i = 0; i < all.size(); i += 12) all[i].seconds *= 30;
  const Fit fit = fit_costs(all, kSoft);
  for (std::size_t i = 0; i < costs.size(); ++i) EXPECT_NEAR(fit.costs[i] / costs[i], 1, 0.05) << i;
  EXPECT_LT(fit.median_error, 0.05);
}

TEST(Fit, SaysWhichUnitsFollowFromOthers) {
  std::vector<Measurement> all = measurements({1e-7, 1e-7, 1e-7, 1e-7, 1e-7}, 60);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> about(0.98, 1.02);
  for (Measurement& m : all) {
    m.units[2] = (3 * m.units[0] + m.units[1]) * about(random);
    m.units[4] = 0;
  }
  const std::vector<double> explained = explained_by_others(all, kSoft);
  for (const std::size_t kind : {0u, 2u}) EXPECT_GT(explained[kind], 0.99) << kind;
  EXPECT_LT(explained[3], 0.8) << "depends on no other";
  EXPECT_EQ(explained[4], 1) << "was never counted";
  EXPECT_TRUE(explained_by_others({}, kSoft).empty());
}

TEST(Fit, UnitsThatAreAlwaysCountedTogetherExplainEachOther) {
  std::vector<Measurement> all = measurements({1e-7, 1e-7}, 40);
  for (Measurement& m : all) m.units[1] = 2 * m.units[0];
  for (const double part : explained_by_others(all, kSoft)) EXPECT_NEAR(part, 1, 1e-6);
}

TEST(Fit, OfNothingIsNothing) { EXPECT_TRUE(fit_costs({}, kSoft).costs.empty()); }

}  // namespace
}  // namespace mars::experiments
