#include "host/preview/reloading_pictures.h"

namespace mars::preview {
namespace {

constexpr std::chrono::milliseconds kSoon{300};  // what takes no longer is not worth a word

}  // namespace

ReloadingPictures::ReloadingPictures(std::filesystem::path path, std::unique_ptr<Previewed> film,
                                     document::FileStamps read, MakeSurface make_surface, const Look& look)
    : film_(std::move(film)),
      make_surface_(std::move(make_surface)),
      surface_(make_surface_(film_->film)),
      pictures_(film_->view, *surface_, look),
      reloader_(std::move(path), std::move(read)) {}

bool ReloadingPictures::renew() {
  std::unique_ptr<Previewed> film = reloader_.take();
  if (!film) return false;
  std::unique_ptr<SurfaceSource> surface = make_surface_(film->film);
  pictures_.change_film(film->view, *surface);
  surface_ = std::move(surface);  // the old one first: it still renders the old film
  film_ = std::move(film);
  return true;
}

std::string ReloadingPictures::state() const {
  const auto loading = reloader_.loading();
  return pictures_.state() + (loading && *loading > kSoon ? "  loading ..." : "");
}

}  // namespace mars::preview
