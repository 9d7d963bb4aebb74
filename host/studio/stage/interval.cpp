#include "host/studio/stage/interval.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <numeric>
#include <span>

namespace mars::studio {
namespace {

template <typename Value>
bool same_bits(const Value& one, const Value& other) {
  return std::memcmp(&one, &other, sizeof one) == 0;
}

const wire::Material& material_of(const wire::FilmData& scene, std::size_t segment) {
  return scene.materials[scene.changes[scene.segments[segment].material.first].value];
}

const wire::Matrix& matrix_of(const wire::FilmData& scene, std::size_t segment) {
  return scene.matrices[scene.changes[scene.segments[segment].motion.first].value];
}

const wire::Matrix& bone_of(const wire::FilmData& scene, std::size_t bone) {
  return scene.matrices[scene.changes[scene.bones[bone].first].value];
}

// Of a skin its bones alone decide.
bool same_place(const wire::FilmData& one, const wire::FilmData& other, std::size_t segment) {
  return one.segments[segment].bone_count > 0 || same_bits(matrix_of(one, segment), matrix_of(other, segment));
}

// Those of a segment that stand elsewhere.
void add_bones(const wire::FilmData& was, const wire::FilmData& now, std::size_t segment, Moved& moved) {
  const wire::Segment& of = now.segments[segment];
  for (std::uint32_t bone = of.first_bone; bone < of.first_bone + of.bone_count; ++bone)
    if (!same_bits(bone_of(was, bone), bone_of(now, bone)))
      moved.segments.push_back({static_cast<std::uint32_t>(now.segments.size()) + bone, 0, bone_of(now, bone)});
}

bool same_settings(wire::FilmSettings one, const wire::FilmSettings& other) {
  one.camera = other.camera;
  return same_bits(one, other);
}

bool same_view(const Shot& one, const Shot& other) {
  return one.width == other.width && one.height == other.height && one.camera == other.camera &&
         same_settings(one.moment->settings, other.moment->settings);
}

bool same_lights(const wire::FilmData& one, const wire::FilmData& other) {
  if (one.light_tracks.size() != other.light_tracks.size()) return false;
  for (std::size_t i = 0; i < one.light_tracks.size(); ++i)
    if (one.lights[one.changes[one.light_tracks[i].first].value] !=
        other.lights[other.changes[other.light_tracks[i].first].value])
      return false;
  return true;
}

// As many segments, with as many bones each.
bool same_skeleton(const wire::FilmData& one, const wire::FilmData& other) {
  return std::equal(one.segments.begin(), one.segments.end(), other.segments.begin(), other.segments.end(),
                    [](const wire::Segment& a, const wire::Segment& b) { return a.bone_count == b.bone_count; });
}

// The same segments of the same shapes, whatever these look like.
bool same_segments(const wire::FilmData& one, const wire::FilmData& other) {
  return one.patches.size() == other.patches.size() &&
         std::equal(one.segments.begin(), one.segments.end(), other.segments.begin(), other.segments.end(),
                    [](const wire::Segment& a, const wire::Segment& b) {
                      return a.shape == b.shape && a.bone_count == b.bone_count && a.blend == b.blend;
                    });
}

bool same_surroundings(const Shot& one, const Shot& other) {
  return same_view(one, other) && same_lights(*one.moment, *other.moment) && same_segments(*one.moment, *other.moment);
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

Interval::Interval(Shot scene, std::vector<std::uint32_t> moving)
    : scene_(std::move(scene)),
      moving_(std::move(moving)),
      moves_(scene_.moment->segments.size() + scene_.moment->bones.size(), char{0}) {
  for (const std::uint32_t number : moving_) moves_[number] = 1;
  for (std::size_t number = 0; number < scene_.moment->segments.size(); ++number) {
    const wire::Segment& segment = scene_.moment->segments[number];
    const auto bones =
        std::span(moves_).subspan(scene_.moment->segments.size() + segment.first_bone, segment.bone_count);
    if (std::ranges::count(bones, char{0}) > 0) moves_[number] = 0;
  }
}

std::optional<std::uint32_t> Interval::material_like(const wire::Material& material, std::uint32_t likely) const {
  const std::vector<wire::Material>& materials = scene_.moment->materials;
  if (materials[likely] == material) return likely;
  const auto found = std::find(materials.begin(), materials.end(), material);
  if (found == materials.end()) return std::nullopt;
  return static_cast<std::uint32_t>(found - materials.begin());
}

std::optional<Moved> Interval::moved_to(const Shot& scene) const {
  if (!same_surroundings(scene_, scene)) return std::nullopt;
  const wire::FilmData &was = *scene_.moment, &now = *scene.moment;
  Moved moved;
  for (std::uint32_t segment = 0; segment < now.segments.size(); ++segment) {
    const std::uint32_t before = was.changes[was.segments[segment].material.first].value;
    const auto material = material_like(material_of(now, segment), before);
    if (!material) return std::nullopt;
    add_bones(was, now, segment, moved);
    if (material == before && same_place(was, now, segment)) continue;
    moved.segments.push_back({segment, *material, matrix_of(now, segment)});
  }
  for (std::uint32_t patch = 0; patch < now.patches.size(); ++patch)
    if (!same_bits(now.patches[patch], was.patches[patch])) moved.patches.push_back({patch, 0, now.patches[patch]});
  return moved;
}

bool Interval::holds(const Moved& moved) const {
  for (const wire::MovedSegment& segment : moved.segments)
    if (moves_[segment.segment] == 0) return false;
  if (moved.patches.empty()) return true;
  for (std::size_t segment = 0; segment < scene_.moment->segments.size(); ++segment)
    if (moves_[segment] == 0 && has_own_shape(*scene_.moment, segment)) return false;
  return true;
}

bool same_picture(const Shot& one, const Shot& other) {
  return same_surroundings(one, other) && changed_parts(one, other).empty();
}

std::vector<std::uint32_t> changed_parts(const Shot& one, const Shot& other) {
  const wire::FilmData &before = *one.moment, &now = *other.moment;
  const bool all = !same_view(one, other) || !same_lights(before, now) || !same_skeleton(before, now);
  const bool pulled = before.patches.size() != now.patches.size() || !same_patches(before, now);
  std::vector<std::uint32_t> changed, bones;
  for (std::uint32_t segment = 0; segment < now.segments.size(); ++segment) {
    const bool whole = all || before.segments[segment].shape != now.segments[segment].shape ||
                       !(material_of(before, segment) == material_of(now, segment)) ||
                       (pulled && has_own_shape(now, segment));
    const std::size_t before_it = bones.size();
    const wire::Segment& of = now.segments[segment];
    for (std::uint32_t bone = of.first_bone; bone < of.first_bone + of.bone_count; ++bone)
      if (whole || !same_bits(bone_of(before, bone), bone_of(now, bone)))
        bones.push_back(static_cast<std::uint32_t>(now.segments.size()) + bone);
    if (whole || bones.size() > before_it || !same_place(before, now, segment)) changed.push_back(segment);
  }
  changed.insert(changed.end(), bones.begin(), bones.end());
  return changed;
}

std::vector<std::uint32_t> joined(std::span<const std::uint32_t> one, std::span<const std::uint32_t> other) {
  std::vector<std::uint32_t> both;
  std::set_union(one.begin(), one.end(), other.begin(), other.end(), std::back_inserter(both));
  return both;
}

}  // namespace mars::studio
