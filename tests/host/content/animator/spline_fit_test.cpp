#include "host/content/animator/keys/spline_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "host/content/animator/pose/channel.h"

namespace mars::animator {
namespace {

DenseCurve curve_of(std::size_t frames, double allowed, const std::function<glm::dvec3(double)>& law) {
  DenseCurve curve;
  for (std::size_t frame = 0; frame < frames; ++frame) curve.values.push_back(law(double(frame)));
  curve.error = [values = curve.values, allowed](std::size_t frame, const glm::dvec3& value) {
    return glm::length(value - values[frame]) / allowed;
  };
  curve.grain = allowed / 100;
  return curve;
}

// What a film makes of the keys.
double worst_of(const DenseCurve& curve, const std::vector<FittedKey>& keys) {
  Channel<glm::dvec3> channel;
  for (const FittedKey& key : keys)
    channel.push_back({static_cast<std::uint32_t>(key.at), key.value, kSpline, key.in, key.out});
  double worst = 0;
  for (std::uint32_t frame = 0; frame < curve.values.size(); ++frame)
    worst = std::max(worst, curve.error(frame, value_at(channel, frame)));
  return worst;
}

TEST(SplineFit, ParabolaTakesTwoKeys) {
  const DenseCurve curve = curve_of(60, 0.01, [](double t) { return glm::dvec3(t / 10, 2, t - t * t / 60); });
  const auto keys = fit_splines({&curve, 1});
  EXPECT_EQ(keys[0].size(), 2u);
  EXPECT_LE(worst_of(curve, keys[0]), 1);
}

TEST(SplineFit, SwingsStayWithinTheErrorWithFewKeys) {
  for (const double allowed : {0.02, 0.2, 2.0}) {
    const DenseCurve curve =
        curve_of(120, allowed, [](double t) { return glm::dvec3(30 * std::sin(t / 4), 10 * std::cos(t / 8), 0); });
    const auto keys = fit_splines({&curve, 1});
    EXPECT_LE(worst_of(curve, keys[0]), 1) << allowed;
    EXPECT_LE(keys[0].size(), 45 / std::sqrt(std::sqrt(allowed / 0.02)) + 3) << allowed;
  }
}

TEST(SplineFit, SharpTurnsKeepTheirFrame) {
  const DenseCurve curve = curve_of(41, 0.1, [](double t) { return glm::dvec3(std::abs(t - 20), 0, 0); });
  const auto keys = fit_splines({&curve, 1});
  ASSERT_EQ(keys[0].size(), 3u);
  EXPECT_EQ(keys[0][1].at, 20u);
  EXPECT_LE(worst_of(curve, keys[0]), 1);
}

TEST(SplineFit, NoiseKeepsItsKeys) {
  const DenseCurve curve = curve_of(30, 0.001, [](double t) { return glm::dvec3(std::sin(t * t), 0, 0); });
  const auto keys = fit_splines({&curve, 1});
  EXPECT_GE(keys[0].size(), 10u);  // two slopes meet two frames between keys
  EXPECT_LE(worst_of(curve, keys[0]), 1);
}

TEST(SplineFit, CurvesTakeKeysFromCommonFrames) {
  const DenseCurve curves[] = {curve_of(90, 0.1, [](double t) { return glm::dvec3(20 * std::sin(t / 5), 0, 0); }),
                               curve_of(90, 0.1, [](double t) { return glm::dvec3(8 * std::sin(t / 10), 0, 0); }),
                               curve_of(90, 0.1, [](double) { return glm::dvec3(3, 0, 0); })};
  const auto keys = fit_splines(curves);
  const auto has = [&](std::size_t frame) {
    return std::ranges::any_of(keys[0], [&](const FittedKey& key) { return key.at == frame; });
  };
  EXPECT_LT(keys[1].size(), keys[0].size());
  for (const FittedKey& key : keys[1]) EXPECT_TRUE(has(key.at)) << key.at;
  EXPECT_EQ(keys[2].size(), 2u);
  for (int i = 0; i < 3; ++i) EXPECT_LE(worst_of(curves[i], keys[i]), 1);
}

}  // namespace
}  // namespace mars::animator
