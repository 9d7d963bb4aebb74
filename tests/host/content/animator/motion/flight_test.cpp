// Kinematic laws against known answers: apex, impacts in geometric series, the end, what friction leaves.
#include "host/content/animator/motion/laws/flight.h"

#include <gtest/gtest.h>

#include <cmath>

#include "host/content/animator/pose/figure.h"
#include "tests/host/content/animator/motion/bodies.h"

namespace mars::motion {
namespace {

constexpr double kG = 9.81;

TEST(Flight, ThrownRisesToItsApexAndComesBack) {
  const Flight flight({{0, 0, 1}, {3, 0, 6}, {0, 0, -kG}});
  const double apex = 6 / kG;
  EXPECT_NEAR(flight.place_at(apex).z, 1 + 36 / (2 * kG), 1e-12);
  EXPECT_NEAR(flight.place_at(apex).x, 3 * apex, 1e-12);
  EXPECT_NEAR(flight.place_at(2 * apex).z, 1, 1e-12);
}

TEST(Flight, BouncesAreAGeometricSeries) {
  const double height = 2, e = 0.8, first = std::sqrt(2 * height / kG);
  const Flight flight({{0, 0, height}, {0, 0, 0}, {0, 0, -kG}}, {.height = 0, .restitution = e, .friction = 0}, 1e-3);
  double impact = first, up = 2 * first;
  for (int bounce = 1; bounce <= 10; ++bounce) {
    EXPECT_NEAR(flight.place_at(impact).z, 0, 1e-9) << bounce;
    EXPECT_NEAR(flight.arcs()[std::size_t(bounce)].time, impact, 1e-9) << bounce;
    up *= e;  // seconds in the air after this impact
    EXPECT_NEAR(flight.place_at(impact + up / 2).z, height * std::pow(e, 2 * bounce), 1e-9) << bounce;
    impact += up;
  }
  EXPECT_NEAR(flight.rest(), first * (1 + e) / (1 - e), 1e-9) << "the sum of all bounces";
  EXPECT_EQ(flight.place_at(flight.rest() + 1), glm::dvec3(0, 0, 0));
}

TEST(Flight, FrictionTakesItsShareAndThenBrakesToRest) {
  const Floor floor{.height = 0, .restitution = 0.5, .friction = 0.2};
  const Flight flight({{0, 0, 1}, {4, 0, 0}, {0, 0, -kG}}, floor, 0.05);
  const auto arcs = flight.arcs();
  ASSERT_GE(arcs.size(), 4u);
  EXPECT_NEAR(arcs[1].launch.velocity.x, 4 * 0.8, 1e-12);
  EXPECT_NEAR(arcs[2].launch.velocity.x, 4 * 0.64, 1e-12);
  const Arc& slide = arcs[arcs.size() - 2];
  const double speed = slide.launch.velocity.x;
  EXPECT_NEAR(flight.rest() - slide.time, speed / (0.2 * kG), 1e-12);
  EXPECT_NEAR(flight.place_at(100).x - slide.launch.place.x, speed * speed / (2 * 0.2 * kG), 1e-12);
  EXPECT_NEAR(flight.turned_at(100), flight.turned_at(flight.rest()), 1e-12) << "nor does it turn any more";
}

// What the film shows at a frame.
glm::dvec3 shown(const document::Json& json, std::uint32_t frame) {
  return animator::value_at(read(json).actors[0].motion.place, frame);
}

document::Json ball_at(double height) {
  document::Json film = film_with(
      {{"joints",
        document::Json::array({jointed("ball", "", {0, 0, 0}, {}, {{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}}, "sphere")})}});
  film["actors"][0]["place"] = {0, 0, height};
  return film;
}

TEST(Bounce, FilmsFollowTheLawAtEveryFrameWithinTheTolerance) {
  document::Json film = ball_at(3.5);
  const Performed done = act(film, "bounce velocity 2 0 1 restitution 0.75 friction 0.1 spin 0 300 0", 10);
  const Flight flight({{0, 0, 3}, {2, 0, 1}, {0, 0, -kG}}, {.height = 0, .restitution = 0.75, .friction = 0.1},
                      1e-3 * (3 + 1 / (2 * kG)));
  for (std::uint32_t frame = done.first; frame <= done.last; ++frame) {
    const glm::dvec3 there = shown(film, frame), law = flight.place_at((frame - 10) / 24.0);
    EXPECT_NEAR(there.x, law.x, 5e-3) << frame;
    EXPECT_NEAR(there.z - 0.5, law.z, 5e-3) << frame << ": its lowest point meets the floor";
  }
  EXPECT_EQ(done.last, 10 + std::uint32_t(std::ceil(flight.rest() * 24)));
}

TEST(Bounce, OfABallThatFallsStraightEndsWithTheSeries) {
  document::Json film = ball_at(2.5);
  const Performed done = act(film, "bounce restitution 0.5", 0);
  EXPECT_EQ(done.last, std::uint32_t(std::ceil(24 * 3 * std::sqrt(4 / kG))));
  EXPECT_EQ(shown(film, done.last).z, 0.5);
}

// A metre is as long as the legs of the film's people have it, for whatever falls there.
TEST(Gravity, IsThatOfTheLargestFigureOnTwoLegs) {
  const auto way_of_half_a_second = [](const std::vector<document::Json>& figures) {
    document::Json film = ball_at(10.5);
    for (std::size_t i = 0; i < figures.size(); ++i) {
      const std::string name = "figure-" + std::to_string(i);
      film["models"][name] = figures[i];
      film["actors"].push_back({{"name", name}, {"model", name}});
    }
    document::Json thrown = film;
    act(thrown, "throw velocity 1 0 0 seconds 0.5", 0);
    const double fallen = 10.5 - shown(thrown, 12).z;
    act(film, "bounce restitution 0", 0);
    EXPECT_NEAR(10.5 - shown(film, 12).z, fallen, 5e-3);
    return fallen;
  };
  const document::Json horse = example("horse");
  const double man = kG * 2.9 / 8, metre = kG / 8;
  EXPECT_NEAR(way_of_half_a_second({}), metre, 1e-2);
  EXPECT_NEAR(way_of_half_a_second({horse}), metre, 1e-2);
  EXPECT_NEAR(way_of_half_a_second({human()}), man, 1e-2);
  EXPECT_NEAR(way_of_half_a_second({built(0.6, 1, 1)}), 0.6 * man, 1e-2);
  EXPECT_NEAR(way_of_half_a_second({built(0.6, 1, 1), human(), horse}), man, 1e-2);
}

TEST(Spin, TurnsEvenlyThroughWholeTurns) {
  document::Json film = ball_at(0);
  film["actors"][0].erase("turn");
  act(film, "spin axis z degrees 720 seconds 3", 0);
  const animator::Film meaning = read(film);
  const modeler::Joint joint;
  animator::JointMotion turning(joint, meaning.actors[0].motion.turn);
  for (std::uint32_t frame = 0; frame <= 72; ++frame) {
    const glm::dmat3 turn = turning.at(frame), wanted = modeler::rotation_by_degrees({0, 0, 1}, 10.0 * frame);
    EXPECT_LT(animator::turn_between(turn, wanted).angle, 1e-3) << frame;
  }
}

}  // namespace
}  // namespace mars::motion
