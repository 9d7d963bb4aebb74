#include "host/content/animator/motion/laws/flight.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace mars::motion {
namespace {

glm::dvec3 after(const Launch& launch, double time) {
  return launch.place + time * launch.velocity + 0.5 * time * time * launch.acceleration;
}

// Seconds until the height is reached from above: h + v t + a t^2 / 2 = 0, a below 0.
double fall_time(double height, double up, double acceleration) {
  return (-up - std::sqrt(std::max(0.0, up * up - 2 * acceleration * height))) / acceleration;
}

double apex(const Arc& arc) { return arc.launch.velocity.z * arc.launch.velocity.z / (-2 * arc.launch.acceleration.z); }

// The arc that begins where this one meets the floor.
Arc bounced(const Arc& arc, const Floor& floor) {
  const Launch& from = arc.launch;
  const double time = fall_time(from.place.z - floor.height, from.velocity.z, from.acceleration.z);
  Arc next = arc;
  next.time += time;
  next.turned += arc.spin * time;
  next.spin *= 1 - floor.friction;
  next.launch.place = after(from, time);
  next.launch.place.z = floor.height;
  const glm::dvec3 velocity = from.velocity + time * from.acceleration;
  next.launch.velocity = (1 - floor.friction) * velocity;
  next.launch.velocity.z = -floor.restitution * velocity.z;
  return next;
}

}  // namespace

Flight::Flight(const Launch& launch, const Floor& floor, double low) : arcs_{{.launch = launch}} {
  do {
    arcs_.push_back(bounced(arcs_.back(), floor));
  } while (apex(arcs_.back()) >= low);
  slide(floor);
}

// What is left of the bounces, 2 up / |down| (1 + e + e^2 + ...) seconds, is too low to be seen; then
// friction brakes.
void Flight::slide(const Floor& floor) {
  Arc& last = arcs_.back();
  const double down = -last.launch.acceleration.z;
  const double bouncing = 2 * last.launch.velocity.z / down / (1 - floor.restitution);
  last.launch.velocity.z = 0;
  last.launch.acceleration = {0, 0, 0};
  const double speed = glm::length(last.launch.velocity);
  if (speed > 0 && floor.friction == 0) return;  // it slides for ever
  const double braked = speed > 0 ? speed / (floor.friction * down) : bouncing;
  if (speed > 0) last.launch.acceleration = -last.launch.velocity / braked;
  last.brake = braked > 0 ? last.spin / braked : 0;
  Arc rest{.time = last.time + braked, .launch = {after(last.launch, braked)}, .spin = 0};
  rest.turned = last.turned + last.spin * braked / 2;
  arcs_.push_back(rest);
}

const Arc& Flight::arc_at(double time) const {
  const auto later =
      std::upper_bound(arcs_.begin(), arcs_.end(), time, [](double t, const Arc& arc) { return t < arc.time; });
  return later == arcs_.begin() ? arcs_.front() : *(later - 1);
}

glm::dvec3 Flight::place_at(double time) const {
  const Arc& arc = arc_at(time);
  return after(arc.launch, time - arc.time);
}

double Flight::turned_at(double time) const {
  const Arc& arc = arc_at(time);
  const double past = time - arc.time;
  return arc.turned + arc.spin * past - arc.brake * past * past / 2;
}

}  // namespace mars::motion
