// A film's pictures, which follow its files: when these change, the film is loaded again and seen as before. While they
// make no film, the last one goes on, and trouble() says why. Keys pose its figures.
#pragma once

#include "host/preview/film_pictures.h"
#include "host/preview/film_reloader.h"
#include "host/preview/pose_keys.h"
#include "host/preview/posed_surface.h"

namespace mars::preview {

class ReloadingPictures : public Pictures {
 public:
  // `film`: what was loaded from `path`, by reading `read`. Has a thread from now on.
  ReloadingPictures(std::filesystem::path path, std::unique_ptr<Previewed> film, document::FileStamps read,
                    MakeSurface make_surface, const Look& look);

  std::uint32_t frames() const override { return pictures_.frames(); }
  double rate() const override { return pictures_.rate(); }
  images::PictureSize extent() const override { return pictures_.extent(); }
  SharedImage picture(std::uint32_t frame, images::PictureSize extent) override;
  bool complete() const override { return pictures_.complete(); }
  bool renew() override;
  std::string trouble() const override { return reloader_.trouble(); }
  bool handle_key(const KeyPress& key, std::uint32_t frame) override;
  bool holds() const override { return pose_keys_.under_way(); }
  std::string note(std::uint32_t frame) const override { return pose_keys_.note(frame); }
  std::string state() const override;
  std::string keys() const override { return pictures_.keys() + PoseKeys::keys(); }

  // Follows the files no longer. Whether its end would wait for a film that is being loaded.
  bool stop() { return reloader_.stop(); }

 private:
  std::unique_ptr<Previewed> film_;
  MakeSurface make_surface_;
  PoseKeys pose_keys_;
  std::unique_ptr<PosedSurface> surface_;
  FilmPictures pictures_;
  FilmReloader reloader_;
};

}  // namespace mars::preview
