#include "host/studio/stage/interval.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <numeric>

namespace mars::studio {
namespace {

template <typename Value>
bool same_bits(const Value& one, const Value& other) {
  return std::memcmp(&one, &other, sizeof one) == 0;
}

const wire::Camera& camera_of(const wire::FilmData& scene) {
  return scene.cameras[scene.changes[scene.settings.camera.first].value];
}

const wire::Material& material_of(const wire::FilmData& scene, std::size_t segment) {
  return scene.materials[scene.changes[scene.segments[segment].material.first].value];
}

const wire::Matrix& matrix_of(const wire::FilmData& scene, std::size_t segment) {
  return scene.matrices[scene.changes[scene.segments[segment].motion.first].value];
}

bool same_settings(wire::FilmSettings one, const wire::FilmSettings& other) {
  one.camera = other.camera;
  return same_bits(one, other);
}

bool same_lights(const wire::FilmData& one, const wire::FilmData& other) {
  if (one.light_tracks.size() != other.light_tracks.size()) return false;
  for (std::size_t i = 0; i < one.light_tracks.size(); ++i)
    if (one.lights[one.changes[one.light_tracks[i].first].value] !=
        other.lights[other.changes[other.light_tracks[i].first].value])
      return false;
  return true;
}

// The same segments of the same shapes, whatever these look like.
bool same_segments(const wire::FilmData& one, const wire::FilmData& other) {
  return one.patches.size() == other.patches.size() &&
         std::equal(one.segments.begin(), one.segments.end(), other.segments.begin(), other.segments.end(),
                    [](const wire::Segment& a, const wire::Segment& b) { return a.shape == b.shape; });
}

bool same_surroundings(const wire::FilmData& one, const wire::FilmData& other) {
  return same_settings(one.settings, other.settings) && camera_of(one) == camera_of(other) && same_lights(one, other) &&
         same_segments(one, other);
}

bool same_patches(const wire::FilmData& one, const wire::FilmData& other) {
  return one.patches.empty() ||
         std::memcmp(one.patches.data(), other.patches.data(), one.patches.size() * sizeof(wire::Patch)) == 0;
}

// Whether the segment has the scene's own shape; there is one at most, whose number is above all of the film's.
bool has_own_shape(const wire::FilmData& scene, std::size_t segment) {
  if (scene.shapes.empty()) return false;
  const auto highest =
      std::max_element(scene.segments.begin(), scene.segments.end(),
                       [](const wire::Segment& a, const wire::Segment& b) { return a.shape < b.shape; });
  return scene.segments[segment].shape == highest->shape;
}

}  // namespace

Interval::Interval(wire::FilmData scene) : scene_(std::move(scene)), moves_(scene_.segments.size(), char{0}) {
  for (const std::uint32_t segment : scene_.moving) moves_[segment] = 1;
}

std::optional<std::uint32_t> Interval::material_like(const wire::Material& material, std::uint32_t likely) const {
  if (scene_.materials[likely] == material) return likely;
  const auto found = std::find(scene_.materials.begin(), scene_.materials.end(), material);
  if (found == scene_.materials.end()) return std::nullopt;
  return static_cast<std::uint32_t>(found - scene_.materials.begin());
}

std::optional<Moved> Interval::moved_to(const wire::FilmData& now) const {
  if (!same_surroundings(scene_, now)) return std::nullopt;
  Moved moved;
  for (std::uint32_t segment = 0; segment < now.segments.size(); ++segment) {
    const std::uint32_t before = scene_.changes[scene_.segments[segment].material.first].value;
    const auto material = material_like(material_of(now, segment), before);
    if (!material) return std::nullopt;
    if (material == before && same_bits(matrix_of(scene_, segment), matrix_of(now, segment))) continue;
    moved.segments.push_back({segment, *material, matrix_of(now, segment)});
  }
  for (std::uint32_t patch = 0; patch < now.patches.size(); ++patch)
    if (!same_bits(now.patches[patch], scene_.patches[patch])) moved.patches.push_back({patch, 0, now.patches[patch]});
  return moved;
}

bool Interval::holds(const Moved& moved) const {
  for (const wire::MovedSegment& segment : moved.segments)
    if (moves_[segment.segment] == 0) return false;
  if (moved.patches.empty()) return true;
  for (std::size_t segment = 0; segment < moves_.size(); ++segment)
    if (moves_[segment] == 0 && has_own_shape(scene_, segment)) return false;
  return true;
}

bool same_picture(const wire::FilmData& one, const wire::FilmData& other) {
  return same_surroundings(one, other) && changed_segments(one, other).empty();
}

std::vector<std::uint32_t> changed_segments(const wire::FilmData& before, const wire::FilmData& now) {
  std::vector<std::uint32_t> changed;
  const bool all = before.segments.size() != now.segments.size() || !same_settings(before.settings, now.settings) ||
                   !(camera_of(before) == camera_of(now)) || !same_lights(before, now);
  const bool pulled = before.patches.size() != now.patches.size() || !same_patches(before, now);
  for (std::uint32_t segment = 0; segment < now.segments.size(); ++segment)
    if (all || before.segments[segment].shape != now.segments[segment].shape ||
        !same_bits(matrix_of(before, segment), matrix_of(now, segment)) ||
        !(material_of(before, segment) == material_of(now, segment)) || (pulled && has_own_shape(now, segment)))
      changed.push_back(segment);
  return changed;
}

std::vector<std::uint32_t> joined(std::span<const std::uint32_t> one, std::span<const std::uint32_t> other) {
  std::vector<std::uint32_t> both;
  std::set_union(one.begin(), one.end(), other.begin(), other.end(), std::back_inserter(both));
  return both;
}

}  // namespace mars::studio
