#include "host/studio/stage/view_message.h"

#include <cmath>

#include "host/studio/stage/page_message.h"

namespace mars::studio {
namespace {

constexpr double kLeastSide = 16, kMostSide = 4096;  // of a view, pixels
constexpr double kMostViewsOfPage = 8;
constexpr double kMostGhosts = 8, kMostGhostStep = 1000;
constexpr const char* kAs[] = {"stick", "vertices", "prisms", "surface"};

glm::dvec3 vector_in(const Json& message, const char* key) {
  const auto found = message.find(key);
  if (found == message.end() || !found->is_array() || found->size() != 3)
    refuse("is no list of three numbers", key, "give x, y and z");
  glm::dvec3 vector;
  for (int axis = 0; axis < 3; ++axis) {
    const Json& number = (*found)[static_cast<std::size_t>(axis)];
    if (!number.is_number() || !(std::abs(number.get<double>()) < 1e9)) refuse("is out of range", key, "below 1e9");
    vector[axis] = number.get<double>();
  }
  return vector;
}

preview::Orbit orbit_in(const Json& orbit) {
  return {vector_in(orbit, "center"), number_in(orbit, "turn", -1e6, 1e6), number_in(orbit, "height", -90, 90),
          number_in(orbit, "distance", 1e-6, 1e9)};
}

GhostFrames ghosts_in(const Json& message) {
  const auto found = message.find("ghosts");
  if (found == message.end() || found->is_null()) return {};
  const auto whole = [&](const char* key, double least, double most) {
    return static_cast<int>(number_in(*found, key, least, most));
  };
  return {whole("before", 0, kMostGhosts), whole("after", 0, kMostGhosts), whole("step", 1, kMostGhostStep)};
}

}  // namespace

std::uint32_t view_number_in(const Json& message) {
  return static_cast<std::uint32_t>(number_in(message, "view", 0, kMostViewsOfPage - 1));
}

ViewMessage read_view(const Json& message) {
  ViewMessage view;
  view.number = view_number_in(message);
  view.width = static_cast<std::uint32_t>(number_in(message, "width", kLeastSide, kMostSide));
  view.height = static_cast<std::uint32_t>(number_in(message, "height", kLeastSide, kMostSide));
  view.from = static_cast<From>(choice_in(message, "from", kFroms));
  view.look = {static_cast<preview::As>(choice_in(message, "as", kAs)), flag_in(message, "hidden", false),
               flag_in(message, "ground", true)};
  if (message.contains("handles")) view.tool = static_cast<Tool>(choice_in(message, "handles", kTools));
  if (message.contains("axes")) view.axes = static_cast<RingAxes>(choice_in(message, "axes", kRingAxes));
  const bool chosen = !message.contains("orbit") || message["orbit"].is_null();
  if (view.from != From::camera && !chosen) view.orbit = orbit_in(message["orbit"]);
  view.ghosts = ghosts_in(message);
  view.marks = flag_in(message, "marks", false);
  return view;
}

}  // namespace mars::studio
