#include "host/content/importer/gltf/film_clock.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "hal/failure/failure.h"
#include "host/content/importer/motions/motion_frames.h"

namespace mars::importer {
namespace {

constexpr double kOnFrame = 2e-3;  // frames; single precision leaves less
constexpr double kUnmoved = 1e-4;  // a share of a place or a scale
constexpr std::size_t kMostFilmFrames = 1'000'000;

bool all_on_frames(const GltfAnimation& animation, double rate) {
  return std::ranges::all_of(animation.channels, [&](const GltfChannel& channel) {
    return std::ranges::all_of(channel.times,
                               [&](double time) { return std::abs(time * rate - std::round(time * rate)) < kOnFrame; });
  });
}

double usual_rate(const GltfScene& scene) {
  if (!scene.animations.shown) return 24;
  for (const double rate : {24.0, 25.0, 30.0, 48.0, 50.0, 60.0, 100.0, 120.0})
    if (all_on_frames(*scene.animations.shown, rate)) return kind_rate(rate);
  return 24;
}

// The value that a channel has at all frames; none where it changes.
std::optional<glm::dvec3> unmoved(const GltfChannel& channel, const FilmClock& clock) {
  glm::dvec3 least(0), greatest(0);
  for (std::size_t frame = 0; frame < clock.frames; ++frame) {
    const auto value = channel.at(clock.time(frame));
    const glm::dvec3 vector(value[0], value[1], value[2]);
    least = frame == 0 ? vector : glm::min(least, vector);
    greatest = frame == 0 ? vector : glm::max(greatest, vector);
  }
  const glm::dvec3 mean = (least + greatest) / 2.0;
  if (glm::length(greatest - least) > kUnmoved * glm::length(mean)) return std::nullopt;
  return mean;
}

}  // namespace

FilmClock film_clock(const std::filesystem::path& path, const GltfScene& scene, const std::optional<double>& rate) {
  FilmClock clock{rate.value_or(usual_rate(scene)), 1};
  const double last = scene.animations.shown ? std::floor(scene.animations.shown->end() * clock.rate + kOnFrame) : 0;
  if (last >= kMostFilmFrames)
    throw Failure("has more than a million frames at this rate", path.string(), "choose a lower --rate");
  clock.frames = static_cast<std::size_t>(std::max(last, 0.0)) + 1;
  return clock;
}

std::vector<glm::dmat4> rest_of_nodes(const GltfScene& scene, const FilmClock& clock) {
  std::vector<GltfPlace> places = scene.nodes.places;
  if (scene.animations.shown)
    for (const GltfChannel& channel : scene.animations.shown->channels) {
      GltfPlace& place = places[channel.node];
      if (channel.path == GltfPath::rotation || place.matrix) continue;
      if (const auto value = unmoved(channel, clock))
        (channel.path == GltfPath::translation ? place.translation : place.scale) = *value;
    }
  std::vector<glm::dmat4> rest;
  for (const GltfPlace& place : places) rest.push_back(place.local());
  return rest;
}

NodesInFilm::NodesInFilm(const GltfScene& scene, const FilmClock& clock, const glm::dmat3& upright, double factor)
    : scene_(scene), clock_(clock), to_film_(upright * factor) {}

std::vector<glm::dmat4> NodesInFilm::in_film(std::vector<glm::dmat4> matrices) const {
  for (glm::dmat4& matrix : matrices) matrix = to_film_ * matrix;
  return matrices;
}

std::vector<glm::dmat4> NodesInFilm::at(std::size_t frame) const {
  return in_film(scene_.matrices_at(clock_.time(frame)));
}

std::vector<glm::dmat4> NodesInFilm::at_rest(const std::vector<glm::dmat4>& rest) const {
  GltfNodes nodes = scene_.nodes;
  for (std::size_t node = 0; node < rest.size(); ++node) nodes.places[node].matrix = rest[node];
  return in_film(gltf_matrices(nodes));
}

}  // namespace mars::importer
