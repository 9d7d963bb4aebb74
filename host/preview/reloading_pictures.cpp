#include "host/preview/reloading_pictures.h"

namespace mars::preview {
namespace {

constexpr std::chrono::milliseconds kSoon{300};  // what takes no longer is not worth a word

}  // namespace

ReloadingPictures::ReloadingPictures(std::filesystem::path path, std::unique_ptr<Previewed> film,
                                     document::FileStamps read, MakeSurface make_surface, const Look& look)
    : film_(std::move(film)),
      make_surface_(std::move(make_surface)),
      pose_keys_(*film_, path),
      surface_(std::make_unique<PosedSurface>(*film_, pose_keys_.pose(), make_surface_)),
      pictures_(film_->wireframe, *surface_, look),
      reloader_(std::move(path), std::move(read)) {}

bool ReloadingPictures::renew() {
  std::unique_ptr<Previewed> film = reloader_.take();
  if (!film) return false;
  auto surface = std::make_unique<PosedSurface>(*film, pose_keys_.pose(), make_surface_);
  pose_keys_.change_film(*film);
  pictures_.change_film(film->wireframe, *surface);
  surface_ = std::move(surface);  // the old one first: it still renders the old film
  film_ = std::move(film);
  return true;
}

SharedImage ReloadingPictures::picture(std::uint32_t frame, images::PictureSize extent) {
  pictures_.pose(pose_keys_.posed_at(frame));
  return pictures_.picture(frame, extent);
}

bool ReloadingPictures::handle_key(const KeyPress& key, std::uint32_t frame) {
  return pose_keys_.handle_key(key, frame) || pictures_.handle_key(key, frame);
}

std::string ReloadingPictures::state() const {
  const auto loading = reloader_.loading();
  return pictures_.state() + (loading && *loading > kSoon ? "  loading ..." : "");
}

}  // namespace mars::preview
