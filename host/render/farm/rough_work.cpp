#include "host/render/farm/rough_work.h"

#include <algorithm>
#include <span>

namespace mars::farm {
namespace {

// Fitted to films of examples/ on one core with AVX-512.
constexpr double kPatch = 1e-6, kSample = 8e-9;
constexpr double kRedrawn = 0.3;  // of a picture, by an inbetween

// Of a moving segment's patches.
double moving_share(const wire::PackedFilm& film, std::span<const std::uint32_t> moving, const wire::Segment& segment) {
  if (segment.bone_count == 0) return 1;
  const std::size_t first = film.segments().size() + segment.first_bone;
  const auto bones =
      std::ranges::lower_bound(moving, first + segment.bone_count) - std::ranges::lower_bound(moving, first);
  return static_cast<double>(bones) / segment.bone_count;
}

}  // namespace

double moving_patches(const wire::PackedFilm& film, const wire::Interval& interval) {
  double patches = 0;
  for (const std::uint32_t number : film.moving_segments(interval)) {
    const wire::Segment& segment = film.segments()[number];
    patches +=
        static_cast<double>(film.shapes()[segment.shape].size()) * moving_share(film, film.moving(interval), segment);
  }
  return patches;
}

RoughWork rough_work(const wire::PackedFilm& film, const wire::Interval& interval) {
  const wire::FilmSettings& settings = film.settings();
  const double samples = static_cast<double>(settings.width) * settings.height * settings.samples;
  return {static_cast<double>(film.patch_instances()) * kPatch + samples * kSample,
          moving_patches(film, interval) * kPatch + samples * kSample * kRedrawn};
}

}  // namespace mars::farm
