#include "host/render/farm/rough_work.h"

namespace mars::farm {
namespace {

// Fitted to films of examples/ on one core with AVX-512.
constexpr double kPatch = 1e-6, kSample = 8e-9;
constexpr double kRedrawn = 0.3;  // of a picture, by an inbetween

}  // namespace

RoughWork rough_work(const wire::PackedFilm& film, const wire::Interval& interval) {
  const wire::FilmSettings& settings = film.settings();
  const double samples = static_cast<double>(settings.width) * settings.height * settings.samples;
  double moving = 0;
  for (const std::uint32_t segment : film.moving(interval))
    moving += static_cast<double>(film.shapes()[film.segments()[segment].shape].size());
  return {static_cast<double>(film.patch_instances()) * kPatch + samples * kSample,
          moving * kPatch + samples * kSample * kRedrawn};
}

}  // namespace mars::farm
