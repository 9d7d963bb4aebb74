#include "host/content/film/changed_frames.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <numeric>
#include <span>
#include <type_traits>
#include <utility>

#include "host/content/film/frame_content.h"

namespace mars::film {
namespace {

using wire::PackedFilm;

// Of structs without padding, bit by bit: 0 and -0 are not the same.
template <typename T>
bool same_bits(std::span<const T> a, std::span<const T> b) {
  static_assert(std::is_trivially_copyable_v<T>);
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

template <typename T>
bool same_bits(const T& a, const T& b) {
  return same_bits(std::span(&a, 1), std::span(&b, 1));
}

// They have no padding, as same_bits() needs it: padding_test.cpp looks at each byte; here, what a compiler without its
// means can see.
static_assert(sizeof(wire::Camera) == sizeof(wire::Matrix) + 7 * sizeof(double));
template <typename T>
constexpr bool kOfFourBytes = alignof(T) == 4 && sizeof(T) % 4 == 0;
static_assert(kOfFourBytes<wire::Light> && kOfFourBytes<wire::Material> && kOfFourBytes<wire::FilmSettings> &&
              kOfFourBytes<wire::AmbientLight> && kOfFourBytes<wire::Fog>);

// Of as many points.
bool same_skin(const PackedFilm& a, const wire::Skin& in_a, const PackedFilm& b, const wire::Skin& in_b,
               std::uint32_t points) {
  return same_bits(a.bones_of(in_a), b.bones_of(in_b)) &&
         same_bits(a.weights_of(in_a, points), b.weights_of(in_b, points));
}

bool same_meshlet(const PackedFilm& a, const wire::Meshlet& in_a, const PackedFilm& b, const wire::Meshlet& in_b) {
  return in_a.vertex_count == in_b.vertex_count && same_skin(a, in_a.skin, b, in_b.skin, in_a.vertex_count) &&
         same_bits(in_a.low, in_b.low) && same_bits(in_a.high, in_b.high) &&
         same_bits(a.mesh_places().subspan(in_a.first_vertex, in_a.vertex_count),
                   b.mesh_places().subspan(in_b.first_vertex, in_b.vertex_count)) &&
         same_bits(a.mesh_normals().subspan(in_a.first_vertex, in_a.vertex_count),
                   b.mesh_normals().subspan(in_b.first_vertex, in_b.vertex_count)) &&
         same_bits(a.mesh_triangles().subspan(in_a.first_triangle, in_a.triangle_count),
                   b.mesh_triangles().subspan(in_b.first_triangle, in_b.triangle_count));
}

bool same_stencil(const PackedFilm& a, const wire::Stencil& in_a, const PackedFilm& b, const wire::Stencil& in_b) {
  return std::ranges::equal(a.terms_of(in_a), b.terms_of(in_b), [&](const auto& one, const auto& other) {
    const wire::NetPoint &point = a.net_points()[one.point], &same = b.net_points()[other.point];
    return same_bits(one.weight, other.weight) && same_bits(point.place, same.place) &&
           same_skin(a, point.skin, b, same.skin, 1);
  });
}

bool same_net_patch(const PackedFilm& a, const wire::NetPatch& in_a, const PackedFilm& b, const wire::NetPatch& in_b) {
  for (std::size_t i = 0; i < in_a.stencils.size(); ++i)
    if (!same_stencil(a, a.stencils()[in_a.stencils[i]], b, b.stencils()[in_b.stencils[i]])) return false;
  return true;
}

bool same_shape(const PackedFilm& a, const wire::Shape& in_a, const PackedFilm& b, const wire::Shape& in_b) {
  if (in_a.meshlet_count != in_b.meshlet_count || in_a.patch_count != in_b.patch_count ||
      in_a.bone_count != in_b.bone_count)
    return false;
  for (std::uint32_t i = 0; i < in_a.patch_count && in_a.bone_count > 0; ++i)
    if (!same_net_patch(a, a.net_patches_of(in_a)[i], b, b.net_patches_of(in_b)[i])) return false;
  for (std::uint32_t i = 0; i < in_a.meshlet_count; ++i)
    if (!same_meshlet(a, a.meshlets()[in_a.first_meshlet + i], b, b.meshlets()[in_b.first_meshlet + i])) return false;
  return same_bits(a.patches().subspan(in_a.first_patch, in_a.patch_count),
                   b.patches().subspan(in_b.first_patch, in_b.patch_count));
}

class Comparison {
 public:
  Comparison(const PackedFilm& before, const PackedFilm& now)
      : before_(before),
        now_(now),
        frames_(std::min(before.settings().frames, now.settings().frames)),
        differences_(std::size_t{frames_} + 1, 0) {}

  std::vector<std::uint32_t> changed() {
    if (!have_same_parts())
      mark(0, frames_);
    else
      compare_values();
    std::vector<std::uint32_t> frames;
    std::int64_t reasons = 0;
    for (std::uint32_t frame = 0; frame < now_.settings().frames; ++frame) {
      if (frame < frames_) reasons += differences_[frame];
      if (frame >= frames_ || reasons > 0) frames.push_back(frame);
    }
    return frames;
  }

 private:
  // What holds throughout the film.
  bool have_same_parts() {
    const auto a = before_.segments(), b = now_.segments();
    if (!same_bits(shown_settings(before_.settings()), shown_settings(now_.settings())) || a.size() != b.size() ||
        before_.light_tracks().size() != now_.light_tracks().size())
      return false;
    for (std::size_t i = 0; i < a.size(); ++i)
      if (!have_same_shape(a[i].shape, b[i].shape) || a[i].bone_count != b[i].bone_count || a[i].blend != b[i].blend)
        return false;
    return true;
  }

  bool have_same_shape(std::uint32_t before, std::uint32_t now) {
    const auto [known, is_new] = same_shapes_.try_emplace({before, now}, false);
    if (is_new) known->second = same_shape(before_, before_.shapes()[before], now_, now_.shapes()[now]);
    return known->second;
  }

  void compare_values() {
    compare(before_.settings().camera, before_.cameras(), now_.settings().camera, now_.cameras());
    for (std::size_t i = 0; i < now_.light_tracks().size(); ++i)
      compare(before_.light_tracks()[i], before_.lights(), now_.light_tracks()[i], now_.lights());
    for (std::size_t i = 0; i < now_.segments().size(); ++i) {
      const wire::Segment &a = before_.segments()[i], &b = now_.segments()[i];
      if (a.bone_count == 0) compare(a.motion, before_.matrices(), b.motion, now_.matrices());
      for (std::size_t bone = 0; bone < a.bone_count; ++bone)
        compare(before_.bones_of(a)[bone], before_.matrices(), now_.bones_of(b)[bone], now_.matrices());
      compare(a.material, before_.materials(), b.material, now_.materials());
    }
    compare_movers();
  }

  // Goes through the changes of both tracks together: between two of them neither value changes.
  template <typename Value>
  void compare(const wire::Track& a, std::span<const Value> of_a, const wire::Track& b, std::span<const Value> of_b) {
    const auto in_a = before_.changes().subspan(a.first, a.count), in_b = now_.changes().subspan(b.first, b.count);
    const auto end_of = [this](std::span<const wire::Change> changes, std::size_t at) {
      return at + 1 < changes.size() ? std::min(changes[at + 1].frame, frames_) : frames_;
    };
    for (std::size_t i = 0, j = 0, frame = 0; frame < frames_;) {
      const std::uint32_t end_a = end_of(in_a, i), end_b = end_of(in_b, j), end = std::min(end_a, end_b);
      if (!same_bits(of_a[in_a[i].value], of_b[in_b[j].value])) mark(static_cast<std::uint32_t>(frame), end);
      i += end_a == end;
      j += end_b == end;
      frame = end;
    }
  }

  // Goes through the intervals of both films together: in two that overlap, the same segments and bones must move.
  void compare_movers() {
    const auto end_of = [](const wire::Interval& interval) { return interval.first_frame + interval.frame_count; };
    for (std::size_t i = 0, j = 0, frame = 0; frame < frames_;) {
      const wire::Interval &a = before_.intervals()[i], &b = now_.intervals()[j];
      const std::uint32_t end = std::min({end_of(a), end_of(b), frames_});
      if (!same_bits(before_.moving(a), now_.moving(b))) mark(static_cast<std::uint32_t>(frame), end);
      i += end_of(a) == end;
      j += end_of(b) == end;
      frame = end;
    }
  }

  void mark(std::uint32_t first, std::uint32_t end) {
    ++differences_[first];
    --differences_[end];
  }

  const PackedFilm &before_, &now_;
  const std::uint32_t frames_;             // that both have
  std::vector<std::int64_t> differences_;  // of each frame, reasons why it has changed, less those of the frame before
  std::map<std::pair<std::uint32_t, std::uint32_t>, bool> same_shapes_;
};

bool have_same_names(const PackedFilm& before, const PackedFilm& now) {
  return std::ranges::equal(before.segments(), now.segments(), [&](const wire::Segment& a, const wire::Segment& b) {
    return before.name(a) == now.name(b) && before.material_name(a) == now.material_name(b);
  });
}

std::vector<std::uint32_t> with_followers(const std::vector<std::uint32_t>& frames, std::uint32_t end) {
  std::vector<std::uint32_t> all;
  for (const std::uint32_t frame : frames)
    for (const std::uint32_t each : {frame, frame + 1})
      if (each < end && (all.empty() || all.back() < each)) all.push_back(each);
  return all;
}

}  // namespace

std::vector<std::uint32_t> changed_frames(const PackedFilm& before, const PackedFilm& now, wire::LayerSet layers) {
  const std::uint32_t frames = now.settings().frames;
  if ((layers & wire::set_of(wire::Layer::surfaces)) != 0 && !have_same_names(before, now)) {
    std::vector<std::uint32_t> all(frames);
    std::iota(all.begin(), all.end(), 0u);
    return all;
  }
  const std::vector<std::uint32_t> changed = Comparison(before, now).changed();
  return (layers & wire::set_of(wire::Layer::motion)) != 0 ? with_followers(changed, frames) : changed;
}

}  // namespace mars::film
