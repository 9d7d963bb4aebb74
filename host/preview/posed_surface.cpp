#include "host/preview/posed_surface.h"

#include "host/content/film/moment.h"

namespace mars::preview {

PosedSurface::PosedSurface(Previewed& film, const PoseUnderWay& pose, const MakeSurface& make_surface)
    : film_(film), pose_(pose), make_surface_(make_surface), film_frames_(make_surface(film.film)) {}

void PosedSurface::aim(images::PictureSize extent, const std::optional<wire::Camera>& camera,
                       std::vector<std::uint32_t> frames) {
  extent_ = extent;
  camera_ = camera;
  shown_.reset();
  film_frames_->aim(extent, camera, std::move(frames));
}

SharedImage PosedSurface::frame(std::uint32_t number) {
  if (pose_.empty()) return film_frames_->frame(number);
  if (const Shown wanted{pose_.number(), number}; shown_ != wanted) render(wanted);
  return moment_frame_->frame(0);
}

void PosedSurface::render(const Shown& wanted) {
  const PosedFilm posed(*film_.source, pose_, wanted.frame);
  auto moment = std::make_unique<film::CompiledFilm>(film::compiled_moment(*film_.source, wanted.frame));
  moment_frame_ = make_surface_(*moment);  // the old one first: it still renders the old moment
  moment_ = std::move(moment);
  moment_frame_->aim(extent_, camera_, {0});
  shown_ = wanted;
}

}  // namespace mars::preview
