#include "host/preview/folder_pictures.h"

#include "host/preview/pose_keys.h"

namespace mars::preview {

FolderPictures::FolderPictures(const std::filesystem::path& folder, const videos::Exposing& exposing)
    : reader_(folder, exposing) {}

images::PictureSize FolderPictures::extent() const {
  return images::with_square_pixels({manifest().width, manifest().height}, double{manifest().place.pixel_aspect});
}

SharedImage FolderPictures::picture(std::uint32_t place, images::PictureSize extent) {
  return std::make_shared<const images::Image>(
      scaled(reader_.read(manifest().frames.at(place)), fitted(this->extent(), extent)));
}

bool FolderPictures::handle_key(const KeyPress& key, std::uint32_t) {
  note_ = is_pose_key(key) ? "rendered frames have no joints to pose: preview their film" : "";
  return is_pose_key(key);
}

}  // namespace mars::preview
