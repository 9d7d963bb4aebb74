#include "host/content/animator/motion/laws/kinematic.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "host/content/animator/motion/body/body.h"
#include "host/content/animator/motion/laws/flight.h"
#include "host/content/animator/motion/body/glide.h"
#include "host/content/animator/motion/scene/gravity.h"

namespace mars::motion {
namespace {

constexpr double kFlightTolerance = 5e-4;  // of the flight's extent
constexpr double kTurnTolerance = 0.05;    // degrees
constexpr double kLowestBounce = 1e-3;     // of the first height: bounces that nobody sees
constexpr double kLongestFlight = 600;     // seconds

std::uint32_t frames_of(const Scene& scene, double seconds) {
  return scene.last_after(std::max(std::ceil(scene.frames(seconds) - 1e-9), 1.0)) - scene.at;
}

using Places = std::function<glm::dvec3(double seconds)>;
using Turns = std::function<double(double seconds)>;  // seconds of the turning speed

// Keys for frames 0 to `last` of the scene; exact there but for the tolerances.
class Sampled {
 public:
  Sampled(const Scene& scene, std::uint32_t last) : scene_(scene), keys_(last + 1) {
    for (std::uint32_t i = 0; i <= last; ++i) keys_[i].frame = scene.at + i;
  }

  void add_places(const Places& place_at) {
    std::vector<glm::dvec3> places;
    glm::dvec3 low(1e300), high(-1e300);
    for (std::size_t i = 0; i < keys_.size(); ++i) {
      places.push_back(place_at(seconds(i)));
      low = glm::min(low, places.back());
      high = glm::max(high, places.back());
    }
    const double tolerance = kFlightTolerance * glm::distance(low, high);
    choose_keys(
        places.size(),
        [&](std::size_t a, std::size_t b, std::size_t at) {
          return glm::distance(glm::mix(places[a], places[b], double(at - a) / double(b - a)), places[at]) > tolerance;
        },
        [&](std::size_t at) { keys_[at].place = animator::rounded(places[at]); });
  }

  // About an axis of the world; the rate in degrees a second.
  void add_turns(const glm::dvec3& spin, const Turns& turned_at) {
    const double speed = glm::length(spin);
    if (speed == 0) return;
    const glm::dmat3 start = actor_turn(posture_of(scene_));
    std::vector<glm::dvec3> turns;
    for (std::size_t i = 0; i < keys_.size(); ++i)
      turns.push_back(animator::rounded(
          canonical_degrees(modeler::rotation_by_degrees(spin / speed, speed * turned_at(seconds(i))) * start)));
    turns.front() = posture_of(scene_).turn;
    choose_keys(
        turns.size(),
        [&](std::size_t a, std::size_t b, std::size_t at) {
          return strays(modeler::Joint{}, turns[a], turns[b], double(at - a) / double(b - a), turns[at],
                        kTurnTolerance);
        },
        [&](std::size_t at) { keys_[at].turn = turns[at]; });
  }

  Motion motion() {
    const std::uint32_t last = keys_.back().frame;
    std::erase_if(keys_, [](const animator::ActorKey& key) { return !key.place && !key.turn; });
    for (animator::ActorKey& key : keys_) key.ease = animator::kLinear;
    return {std::move(keys_), last, ""};
  }

 private:
  double seconds(std::size_t frame) const { return double(frame) / scene_.film.rate; }

  const Scene& scene_;
  std::vector<animator::ActorKey> keys_;
};

Motion flown(const Scene& scene, const Flight& flight, double seconds) {
  Sampled sampled(scene, frames_of(scene, seconds));
  sampled.add_places([&](double time) { return flight.place_at(time); });
  sampled.add_turns(scene.arguments.vector("spin").value_or(glm::dvec3(0)),
                    [&](double time) { return flight.turned_at(time); });
  return sampled.motion();
}

}  // namespace

Motion fling(const Scene& scene) {
  const Arguments& arguments = scene.arguments;
  const Flight flight({posture_of(scene).place, arguments.vector("velocity").value_or(glm::dvec3(0)),
                       arguments.vector("acceleration").value_or(glm::dvec3(0, 0, -gravity_in(scene.film)))});
  return flown(scene, flight, arguments.number("seconds", 1, {0.001, kLongestFlight}));
}

Motion bounce(const Scene& scene) {
  const Arguments& arguments = scene.arguments;
  const Posture posture = posture_of(scene);
  const double below = posture.place.z - lowest_of(scene.model(), posture);
  const Launch launch{posture.place,
                      arguments.vector("velocity").value_or(glm::dvec3(0)),
                      {0, 0, -arguments.number("gravity", gravity_in(scene.film), {1e-6, document::kFarthest})}};
  const Floor floor{arguments.number("floor", 0, {}) + below, arguments.number("restitution", 0.7, {0, 0.99}),
                    arguments.number("friction", 0.1, {0, 1})};
  const double height = launch.place.z - floor.height;
  if (height < -1e-9 * (1 + std::abs(floor.height)))
    arguments.refuse("floor",
                     "is " + document::shown(floor.height - below) + ", above the lowest point of '" +
                         scene.actor.name + "'",
                     "start higher, or lower the floor");
  const double up = std::max(0.0, launch.velocity.z);
  const double top = std::max(1e-9, height + up * up / (2 * -launch.acceleration.z));
  const Flight flight(launch, floor, kLowestBounce * top);
  const bool slides = glm::length(flight.arcs().back().launch.velocity) > 0;
  const double rest = slides ? flight.rest() + 1 : flight.rest();
  Motion motion =
      flown(scene, flight, arguments.number("seconds", std::min(rest, kLongestFlight), {0.001, kLongestFlight}));
  const auto hundredths = [](double value) { return document::shown(std::round(value * 100) / 100); };
  motion.report = "first on the floor after " + hundredths(flight.arcs()[1].time) + " s, " +
                  (slides ? "bounces for " : "at rest after ") + hundredths(flight.rest()) + " s";
  return motion;
}

Motion spin(const Scene& scene) {
  const Arguments& arguments = scene.arguments;
  constexpr std::string_view names[] = {"x", "y", "z"};
  glm::dvec3 axis(0);
  axis[static_cast<int>(arguments.choice("axis", 2, names))] = 1;
  const double seconds = arguments.number("seconds", 2, {0.001, kLongestFlight});
  const double degrees = arguments.number("degrees", 360, {-1e6, 1e6});
  const std::uint32_t frames = frames_of(scene, seconds);
  Sampled sampled(scene, frames);
  const double speed = degrees / (frames / scene.film.rate);
  sampled.add_turns((speed < 0 ? -1.0 : 1.0) * axis * std::abs(speed), [](double time) { return time; });
  return sampled.motion();
}

Motion go(const Scene& scene) {
  const auto to = scene.arguments.vector("to");
  if (!to) scene.arguments.refuse("to", "is missing", "say where: to 2 0 0");
  constexpr std::string_view names[] = {"linear", "in", "out", "both"};
  constexpr animator::Ease eases[] = {animator::kLinear, animator::kIn, animator::kOut, animator::kBoth};
  const std::uint32_t last = scene.at + frames_of(scene, scene.arguments.number("seconds", 1, {0.001, kLongestFlight}));
  animator::ActorKey from, there;
  from.frame = scene.at;
  there.frame = last;
  from.place = animator::rounded(posture_of(scene).place);
  from.ease = eases[scene.arguments.choice("ease", 3, names)];
  there.place = *to;
  return {{from, there}, last, ""};
}

}  // namespace mars::motion
